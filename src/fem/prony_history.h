// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "element_schedule.h"
#include "palpate/base/state_bytes.h"
#include "palpate/base/thread_pool.h"
#include "palpate/base/types.h"
#include "palpate/fem/composition.h"
#include "palpate/mesh/mesh_change.h"
#include "shared_batches.h"

namespace palpate::fem {

/// Viscous memory of the integration points. With S the second Piola-Kirchhoff stress of the
/// distortional energy, and x_i = h/tau_i, the stress at the end of a step of length h is
///
///     (1 - sum g_i) S + sum Q_i,   Q_i <- exp(-x_i) Q_i + g_i (1 - exp(-x_i))/x_i (S - S_begin)
///
/// [Holzapfel 2000, sec. 6.10, after Simo 1987; Taylor, Pister, Goudreau 1970 for the recursion],
/// exact for S linear over the step. It is the gradient of factor * psi + 1/2 H : (C - I), with
/// factor and H from this class. So a viscous step also minimises a potential.
///
/// S is zero at points with det F <= kNoStress.
///
/// Points of viscous solids are in batches of eight, component by component, as kernels read them.
class PronyHistory {
 public:
  /// Points are in the order of `runs`, all points of an element consecutively; a run begins a
  /// batch. `pool` may be null and must outlive the memory.
  PronyHistory(const Composition& composition, const std::vector<ElementRun>& runs,
               int num_elements, int points_per_element, ThreadPool* pool);

  /// Whether no solid is viscous; then only factor() may be called.
  bool empty() const { return !viscous_; }
  bool isViscous(int solid) const { return !state_.terms[solid].empty(); }

  /// Begins a step of `h` [s]; infinite h: full relaxation.
  void beginStep(double h);
  /// Factor of the distortional energy of each solid.
  const std::vector<double>& factors() const { return state_.factor; }
  double factor(int solid) const { return state_.factor[solid]; }
  /// H at integration point `q` of element `e`, symmetric [Pa]; zero if not viscous.
  Mat3 stress(int e, int q) const;
  /// H of all batches.
  const SymmetricBatch* stresses() const { return state_.H.data(); }
  /// Batch of the first point of `e`; -1: not viscous.
  int batchOf(int e) const;

  /// Destination of S at the end of a step, to be written before endStep() or relax().
  SymmetricBatch* stressesAtEnd() { return S_end_.data(); }
  void setStressAtEnd(int e, int q, const Mat3& S);
  /// Ends the step.
  void endStep();
  /// Sets the state that constant stresses would reach after infinite time.
  void relax();

  /// As Elasticity::goOnFrom(); `old_volumes`: volumes of the old elements.
  void goOnFrom(const PronyHistory& old, const mesh::MeshChange& change,
                const std::vector<double>& old_volumes);
  void save(StateWriter* out) const;
  /// @throws std::invalid_argument for the memory of another body.
  void restore(StateReader* in);

  struct Term {
    double g, tau, decay, gain;  // exp(-x), g (1 - exp(-x))/x
  };
  /// All variable data; copies share memory.
  struct State {
    std::vector<std::vector<Term>> terms;  // of each solid
    std::vector<double> factor;
    SharedBatches S, H, Q;
  };
  const State& state() const { return state_; }
  void setState(const State& state) { state_ = state; }

 private:
  struct Batch {
    int solid;
    int first_Q;  // first Q of the terms, which are consecutive
  };
  // Position of a point in all arrays but Q.
  struct Slot {
    int batch, lane;
  };
  const std::vector<Term>& terms(const Batch& batch) const { return state_.terms[batch.solid]; }
  Slot slot(int e, int q) const;
  void addBatches(const ElementRun& run);
  void setTerms(double h);
  int numTensors(int batch) const;
  const SymmetricBatch& tensors(int batch, int k) const;
  /// Sets all tensors by tensor(e, q, k), in this order; for elastic points k = 0, 1.
  template <class TensorAt>
  void setAll(const TensorAt& tensor);

  int points_per_element_;
  ThreadPool* pool_;
  bool viscous_ = false;
  std::vector<int> first_slot_;  // 8 batch + lane of each element; -1: not viscous
  std::vector<Batch> batches_;
  State state_;
  std::vector<SymmetricBatch> S_end_;
};

}  // namespace palpate::fem
