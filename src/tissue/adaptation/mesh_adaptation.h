// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "palpate/base/thread_pool.h"
#include "palpate/mesh/nested_mesh.h"
#include "palpate/solver/interrupt.h"
#include "palpate/tissue/adapt_settings.h"
#include "tissue/organ/fem_organ.h"
#include "tool_distance.h"

namespace palpate::tissue {

/// Makes the next mesh of an adaptive organ and the body on it in a background task, and prepares
/// its solver at the positions given to begin(). The result depends only on the present mesh and
/// the arguments of begin().
class MeshAdaptation {
 public:
  MeshAdaptation(const mesh::TetMesh& coarse, const fem::Composition& composition,
                 const Surroundings& surroundings, const FemSettings& settings,
                 const AdaptSettings& adapt, ThreadPool* pool);

  void useMethod(const std::string& method) { settings_.method = method; }
  /// Distance from a tool beyond which the coarse mesh suffices [m].
  double reach() const;

  /// Makes a body on the present mesh, in its rest configuration.
  std::unique_ptr<FemOrgan> make() const;
  /// Sets the body on the coarse mesh. @pre It outlives this.
  void setCoarse(FemOrgan* organ) { coarse_organ_ = organ; }
  bool isCoarse() const { return coarse_; }
  /// Present mesh, as mesh::NestedMesh::bisected(); valid during the background task.
  const std::string& bisected() const { return bisected_; }
  /// Sets the present mesh; "": the coarse one. Cancels the background task.
  /// @throws std::invalid_argument as mesh::NestedMesh::restore().
  void restore(const std::string& bisected);

  /// Begins the background task: mesh with edges of `finest` [m] at these tools, with positions x,
  /// 3 x n [m], for cycles of `dt` [s].
  void begin(const Points& x, const ToolDistance& tools, double finest, double dt);
  struct Result {
    std::unique_ptr<mesh::MeshChange> change;  ///< Null: the present mesh is kept.
    std::unique_ptr<FemOrgan> organ;           ///< Null: the body on the coarse mesh.
    bool complete = true;                      ///< False: kMaxBisections was reached.
  };
  /// Waits for the background task until `interrupt`. Returns whether take() is ready.
  bool await(const solver::Interrupt& interrupt) const;
  /// Whether take() is ready, or no thread prepares it.
  bool isReady() const;
  /// Waits for the task and makes its mesh the present one.
  Result take();

  /// Writes the arguments of begin().
  /// @pre A task is under way.
  void saveTask(StateWriter* out) const;
  /// Reads the arguments; resume() begins the task.
  void restoreTask(StateReader* in);
  /// Begins a restored task.
  /// @pre `obstacles` have the shapes of the tools of begin().
  void resume(const std::vector<contact::Obstacle>& obstacles);

 private:
  void beginWork();
  void work();
  Surroundings surroundings() const;

  fem::Composition composition_;  // on the coarse mesh
  Surroundings surroundings_;     // on the coarse mesh
  FemSettings settings_;
  AdaptSettings adapt_;
  ThreadPool* pool_;
  double coarsest_ = 0.0;  // edge length [m]
  mesh::NestedMesh nested_;
  bool coarse_ = true;
  FemOrgan* coarse_organ_ = nullptr;
  std::string bisected_;

  Points x_;
  double finest_ = 0.0, dt_ = 0.0;
  ToolDistance tools_;
  bool to_resume_ = false;
  Result result_;
  std::atomic<bool> is_made_{false};
  ThreadPool::BackgroundTask task_;  // last member: destroyed before the members it uses
};

}  // namespace palpate::tissue
