// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "element_schedule.h"
#include "kernels/tet_kernels.h"
#include "nodal_pressure.h"
#include "palpate/base/thread_pool.h"
#include "palpate/fem/composition.h"
#include "palpate/fem/stiffness.h"
#include "prony_history.h"
#include "rest_shape.h"
#include "upper_blocks.h"

namespace palpate::fem {

/// Tetrahedra of N nodes whose laws have vector kernels, packed for these. What is computed at one
/// x is kept for the next call at the same x.
template <int N>
class PackedTetrahedra {
 public:
  /// All solids have laws with kernels, and no edge is bent.
  static bool fits(const mesh::TetMesh& mesh, const Composition& composition);

  /// Of a body that fits. `element_kappa`: the part of each solid's bulk modulus that the elements
  /// have [Pa]; `pressure` has the rest, if there is one. `history` has the points of
  /// `schedule.runs()`, `pattern` is that of the matrix. All pointers must outlive this.
  PackedTetrahedra(const ElementSchedule& schedule, const RestShape<N>& shape,
                   const Composition& composition, const std::vector<double>& element_kappa,
                   NodalPressure* pressure, const PronyHistory* history, const BlockMatrix& pattern,
                   ThreadPool* pool, Isa isa = bestIsa());

  double energy(const Points& x);
  double gradient(const Points& x, Points* g);
  void hessian(const Points& x, Stiffness* K);
  double minJacobian(const Points& x);
  /// Of the distortional energy of all viscous points, as PronyHistory::stressesAtEnd().
  void distortionalStresses(const Points& x, SymmetricBatch* S);
  /// The pressures were changed by somebody else.
  void forget() { at_x_ = false; }
  /// A step was begun, or the viscous memory is another one.
  void forgetMemory() { energy_at_x_ = gradient_at_x_ = false; }

 private:
  void pack(const std::vector<int>& elements, const RestShape<N>& shape,
            const BlockMatrix& pattern);
  void packPressures(int e, const std::array<int, N>& order, int lane, TetPressures<N>* packed);
  /// visit(run) on all runs, in an order that the number of threads does not change.
  template <class Visit>
  void forRuns(const Visit& visit) const;
  /// Brings the pressures to x, and J where there are any.
  void moveTo(const Points& x);
  double sumEnergies() const;
  TetArrays<N> arrays();

  const TetKernels<N>& kernels_;
  const ExpandRow expand_row_;
  ThreadPool* pool_;
  NodalPressure* pressure_;  // may be null
  const PronyHistory& history_;
  UpperBlocks upper_;
  std::vector<TetBatch<N>> batches_;
  std::vector<TetBlocks<N>> blocks_;
  std::vector<TetPressures<N>> pressures_;
  std::vector<std::vector<std::vector<TetRun>>> phases_;  // runs of the parts of the phases
  std::vector<double> J_, energy_;
  Points x_;  // where all this is
  Points gradient_;
  bool at_x_ = false, energy_at_x_ = false, gradient_at_x_ = false;
};

}  // namespace palpate::fem
