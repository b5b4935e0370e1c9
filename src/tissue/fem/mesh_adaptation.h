// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "fem_organ.h"
#include "palpate/base/thread_pool.h"
#include "palpate/mesh/nested_mesh.h"
#include "palpate/solver/interrupt.h"
#include "palpate/tissue/adapt_settings.h"
#include "tool_distance.h"

namespace palpate::tissue {

/// Makes the next mesh of an organ that adapts, and the body on it, beside the cycles, and prepares
/// it for where begin() was told that the tissue is: what factorises has its first factor by then.
/// All that depends on the present mesh and on what begin() got alone.
class MeshAdaptation {
 public:
  MeshAdaptation(const mesh::TetMesh& coarse, const fem::Composition& composition,
                 const Surroundings& surroundings, const FemSettings& settings,
                 const AdaptSettings& adapt, ThreadPool* pool);

  void useMethod(const std::string& method) { settings_.method = method; }
  /// Farther from a tool than this the coarse mesh is as fine as is asked for [m].
  double reach() const;

  /// A body on the present mesh, not settled and as yet anywhere.
  std::unique_ptr<FemOrgan> make() const;
  /// That on the coarse mesh, which outlives it and is in use now or later.
  void setCoarse(FemOrgan* organ) { coarse_organ_ = organ; }
  bool isCoarse() const { return coarse_; }
  /// The present mesh, see mesh::NestedMesh::bisected(); also while the next one is being made.
  const std::string& bisected() const { return bisected_; }
  /// Makes it the present one; "": the coarse one. What is being made is given up.
  /// @throws std::invalid_argument as mesh::NestedMesh::restore().
  void restore(const std::string& bisected);

  /// Begins with the mesh that suits these tools where the points are at x, 3 x n [m], for cycles
  /// of `dt` [s].
  void begin(const Points& x, const ToolDistance& tools, double dt);
  struct Result {
    std::unique_ptr<mesh::MeshChange> change;  ///< Null: the present mesh suits.
    std::unique_ptr<FemOrgan> organ;           ///< Null: it is that on the coarse mesh.
    bool complete = true;                      ///< Else some work was left to the next one.
  };
  /// Whether take() need not wait for a helper of the pool: waits until so, or until `interrupt`
  /// asks for the end.
  bool await(const solver::Interrupt& interrupt) const;
  /// Waits for it; it is the present one now.
  Result take();

  /// What begin() got, while it is under way.
  void saveTask(StateWriter* out) const;
  /// It begins anew at the first resume().
  void restoreTask(StateReader* in);
  /// `obstacles`: of the same shapes as those that the tools of begin() were.
  void resume(const std::vector<contact::Obstacle>& obstacles);

 private:
  void beginWork();
  void work();
  Surroundings surroundings() const;

  fem::Composition composition_;  // of the coarse mesh
  Surroundings surroundings_;     // likewise
  FemSettings settings_;
  AdaptSettings adapt_;
  ThreadPool* pool_;
  double coarsest_ = 0.0;  // edge length [m]
  mesh::NestedMesh nested_;
  bool coarse_ = true;
  FemOrgan* coarse_organ_ = nullptr;
  std::string bisected_;

  Points x_;
  double dt_ = 0.0;
  ToolDistance tools_;
  bool to_resume_ = false;
  Result result_;
  std::atomic<bool> is_made_{false};
  ThreadPool::BackgroundTask task_;  // last: ends before what it works on
};

}  // namespace palpate::tissue
