// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/haptics/body_wrench.h"
#include "palpate/haptics/tool_proxy.h"
#include "palpate/instrument/instrument.h"
#include "palpate/mesh/cell_mesh.h"
#include "palpate/scene/scene.h"
#include "palpate/sim/simulator_state.h"
#include "palpate/sim/step_report.h"
#include "palpate/solver/interrupt.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::sim {

/// Poses of all links of an instrument, `X_WL[i]` of link i in world; empty: the instrument is
/// absent.
using LinkPoses = haptics::ToolProxy::LinkPoses;

/// Largest distance of links from the world's origin [m], for accuracy.
inline constexpr double kReach = 1.0e3;
/// Whether all poses are finite, and within kReach.
bool inReach(const LinkPoses& poses);

/// A contact for display: of a tool or part of the anatomy with an organ, or of both with each
/// other.
struct ContactPoint {
  static constexpr int kNone = -1;

  int instrument = kNone;
  int organ = kNone;
  int anatomy = kNone;
  Vec3 p_W;      ///< Point of the tissue's or tool's surface, world [m].
  Vec3 force_W;  ///< Force of organ or anatomy on the other body, world [N].
};

/// Results of a cycle for haptics and display.
struct InstrumentResult {
  /// Wrench of tissue and anatomy on the tool about the control frame's origin, world [N], [N m].
  /// After a failed solve the last one fades: haptics::WrenchFade, within `rates.ramp` of simulated
  /// time.
  Wrench spatial;
  Wrench solved;  ///< Wrench of the last solved state, without fade, for fades in real time.
  Pose X_WC = Pose::Identity();  ///< Pose of the control frame of a present tool, world.
  bool there = false;            ///< Whether the tool is present; its wrench fades when it leaves.
  bool live = false;     ///< Whether the tool is present and solved: `spatial` is of this cycle.
  bool waiting = false;  ///< Whether an absent tool waits for a pose clear of all surfaces.

  /// `spatial` expressed in the control frame.
  Wrench body() const { return haptics::bodyWrench(spatial, X_WC.linear()); }
  int contacts = 0;
  double max_penetration = 0.0;  ///< Largest [m]; in Lockstep of all steps of an input.
};

struct StepResult {
  std::vector<InstrumentResult> instruments;  ///< In the scene's order.
  std::vector<ContactPoint> contacts;
  StepReport report;

  /// Resets to this number of instruments, but keeps capacities.
  void clear(std::size_t num_instruments) {
    instruments.assign(num_instruments, InstrumentResult());
    contacts.clear();
    report = StepReport();
  }
};

/// Receives progress of loading: task and fraction in [0, 1].
using Progress = std::function<void(const std::string& what, double fraction)>;

/// A loaded scene and its simulation. The constructor reads and meshes; step() simulates a cycle
/// and never throws. Equal scenes and inputs give bitwise equal results for any number of threads.
/// Not copyable, since solvers refer to meshes.
class Simulator {
 public:
  /// @throws InputError for errors in files that the scene names.
  explicit Simulator(const scene::Scene& scene, const Progress& progress = {});
  ~Simulator();
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  const scene::Scene& scene() const;
  const std::vector<std::string>& warnings()
      const;  ///< Warnings of loading, such as repairs or missing visuals.
  /// Decisions of loading, such as the method for `auto` or grids of nonconvex shapes.
  const std::vector<std::string>& notes() const;

  int numInstruments() const;
  const instrument::Instrument& instrument(int i) const;
  int controlLink(int i) const;  ///< Link index of the control frame.
  /// Link poses in world for positions of instrument(i).joints() [m or rad].
  LinkPoses linkPoses(int i, const Eigen::VectorXd& joints) const;

  int numOrgans() const;
  const std::string& organName(int i) const;
  std::vector<std::string> methods(int i) const;  ///< See tissue::TissueModel::methods().
  /// Whether a step may be longer than `solver.step` at about the same cost: all organs have
  /// methods of finite elements without explicit steps.
  bool stepsMayGrow() const;
  /// Whether a method of an organ calls BLAS in cycles.
  bool wantsFastBlas() const;
  /// Present surface state of an organ; the revision changes with the mesh. References are valid
  /// until the next step().
  tissue::SurfaceState surfaceState(int i) const;
  const Points& positions(
      int i) const;  ///< Positions of a solved state, world, 3 x n [m]; always finite.
  /// Rest positions, world [m], and cells, or the surface's triangles where the model has none.
  /// Computed in each call.
  mesh::CellMesh cells(int i) const;

  int numAnatomy() const;
  /// Surface of a part of the anatomy, world [m]; constant.
  mesh::SurfaceMesh anatomySurface(int i) const;

  /// Simulates a cycle of `dt` [s] in which instrument i moves to `poses[i]`, or as far as its
  /// proxy may. In the first cycle, or when an instrument reappears, it begins at `poses[i]`. Empty
  /// poses: the instrument is absent. Invalid input (not inReach(), dt <= 0) keeps the state, is
  /// reported, and fades the wrench.
  const StepResult& step(const std::vector<LinkPoses>& poses, double dt) noexcept;

  /// Sets a predicate that steps poll after their first iterations: true ends the step with the
  /// best state and status `deadline`, without a valid wrench. Empty, the default: none. Results
  /// then depend on the time of the interrupt.
  void setInterrupt(solver::Interrupt interrupt);
  /// See tissue::TissueModel::setMeshPace().
  void setMeshPace(const tissue::MeshPace& pace);

  /// Resets to the initial equilibrium at time 0.
  void reset();
  /// Whether instrument i at `poses` would be clear of all present tissue and of the anatomy.
  bool isFree(int i, const LinkPoses& poses) const;
  /// Sets positions [m] and velocities [m/s] of an organ, 3 x n, and clears its other state.
  /// @throws std::invalid_argument for sizes other than the organ's, or values that are not finite.
  void setPositions(int i, const Points& positions, const Points& velocities);

  double time() const;  ///< Simulated time [s].

  /// Returns the whole state, without changing it.
  SimulatorState state() const;
  /// Sets the state; later results are bitwise equal to those of the simulator of that state().
  /// @throws std::invalid_argument for a state of another scene, model or method, or a truncated
  /// one; this simulator is then unchanged.
  void restore(const SimulatorState& state);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate::sim
