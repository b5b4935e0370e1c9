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

/// Tetrahedra of N nodes packed for vector kernels. Results at one x are kept for the next call at
/// the same x.
template <int N>
class PackedTetrahedra {
 public:
  /// Whether all solids have laws with kernels and all edges are straight.
  static bool fits(const mesh::TetMesh& mesh, const Composition& composition);

  /// For a body that fits(). `element_kappa`: the elements' part of each solid's bulk modulus [Pa];
  /// `pressure`, if not null, has the rest. `history` has the points of `schedule.runs()`,
  /// `pattern` is that of the matrix. All pointers must outlive this.
  PackedTetrahedra(const ElementSchedule& schedule, const RestShape<N>& shape,
                   const Composition& composition, const std::vector<double>& element_kappa,
                   NodalPressure* pressure, const PronyHistory* history, const BlockMatrix& pattern,
                   ThreadPool* pool, Isa isa = bestIsa());

  double energy(const Points& x);
  double gradient(const Points& x, Points* g);
  void hessian(const Points& x, Stiffness* K);
  double minJacobian(const Points& x);
  /// Distortional stresses of all viscous points, as for PronyHistory::stressesAtEnd().
  void distortionalStresses(const Points& x, SymmetricBatch* S);
  /// Discards results at x after another change of the pressures.
  void forget() { at_x_ = false; }
  /// Discards results that depend on the step or the viscous memory.
  void forgetMemory() { energy_at_x_ = gradient_at_x_ = false; }

 private:
  void pack(const std::vector<int>& elements, const RestShape<N>& shape,
            const BlockMatrix& pattern);
  void packPressures(int e, const std::array<int, N>& order, int lane, TetPressures<N>* packed);
  /// Calls visit(run) for all runs, in an order independent of the number of threads.
  template <class Visit>
  void forRuns(const Visit& visit) const;
  /// Updates the pressures, and J where there are any, to x.
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
  std::vector<std::vector<std::vector<TetRun>>> phases_;  // runs of each part of each phase
  std::vector<double> J_, energy_;
  Points x_;  // positions of the kept results
  Points gradient_;
  bool at_x_ = false, energy_at_x_ = false, gradient_at_x_ = false;
};

}  // namespace palpate::fem
