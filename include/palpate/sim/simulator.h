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

/// Where all links of one instrument are: `X_WL[i]` maps link i to world. Empty: it is not there.
using LinkPoses = haptics::ToolProxy::LinkPoses;

/// How far from the origin of world links may be [m]. Farther away, rounding is more than a tool.
inline constexpr double kReach = 1.0e3;
/// Whether all poses are finite, and within kReach.
bool inReach(const LinkPoses& poses);

/// One touching point, for pictures: of a tool or a part of the anatomy with an organ, or of both
/// with one another.
struct ContactPoint {
  static constexpr int kNone = -1;

  int instrument = kNone;
  int organ = kNone;
  int anatomy = kNone;
  Vec3 p_W;      ///< Point of the tissue surface, or of the tool's [m].
  Vec3 force_W;  ///< What the organ, or the anatomy, does to the other one [N].
};

/// What the hand and the eyes get from a cycle.
struct InstrumentResult {
  /// Tissue and anatomy on tool at the control frame's origin, expressed in world. After a failed
  /// solve that of the last solved state fades (haptics::WrenchFade, in `rates.ramp` of simulated
  /// time).
  Wrench spatial;
  Wrench solved;  ///< The same of the last solved state, whole: for who fades it in real time.
  Pose X_WC = Pose::Identity();  ///< The control frame in world, of a tool that is there.
  bool there = false;            ///< The tool could touch. If it goes, what it felt fades.
  bool live = false;     ///< It is there, and the solve good enough: `spatial` is of this cycle.
  bool waiting = false;  ///< It is commanded to where it would be inside something, not there yet.

  /// `spatial` expressed in the control frame.
  Wrench body() const { return haptics::bodyWrench(spatial, X_WC.linear()); }
  int contacts = 0;
  double max_penetration = 0.0;  ///< [m]; of an input that Lockstep cuts, of all its steps.
};

struct StepResult {
  std::vector<InstrumentResult> instruments;  ///< In the scene's order.
  std::vector<ContactPoint> contacts;
  StepReport report;

  /// As new, with so many instruments, but with its memory.
  void clear(std::size_t num_instruments) {
    instruments.assign(num_instruments, InstrumentResult());
    contacts.clear();
    report = StepReport();
  }
};

/// Told while loading takes long: what is done, and a fraction in [0, 1].
using Progress = std::function<void(const std::string& what, double fraction)>;

/// A loaded scene and its cycle. Construct once (reads, meshes, may take long, may throw); then
/// step() for ever, which never throws. Same scene, same inputs: same bits, whatever the number of
/// threads. Not copyable: the solvers keep references to their meshes.
class Simulator {
 public:
  /// @throws InputError for anything wrong in a file that the scene names.
  explicit Simulator(const scene::Scene& scene, const Progress& progress = {});
  ~Simulator();
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  const scene::Scene& scene() const;
  const std::vector<std::string>& warnings() const;  ///< Of loading: repairs, missing visuals ...
  /// What loading decided: the method for `auto`, the grids of shapes that are not convex.
  const std::vector<std::string>& notes() const;

  int numInstruments() const;
  const instrument::Instrument& instrument(int i) const;
  int controlLink(int i) const;  ///< Index of its control frame among its links.
  /// Link poses in world for positions of instrument(i).joints() [m or rad].
  LinkPoses linkPoses(int i, const Eigen::VectorXd& joints) const;

  int numOrgans() const;
  const std::string& organName(int i) const;
  std::vector<std::string> methods(int i) const;  ///< See tissue::TissueModel::methods().
  /// Whether an organ's method has cycles that wait for BLAS.
  bool wantsFastBlas() const;
  /// What there is of it now: points and its surface, which may become another one (its revision
  /// says so). The references hold until the next step().
  tissue::SurfaceState surfaceState(int i) const;
  const Points& positions(int i) const;  ///< World, 3 x n [m]; a solved state, always finite.
  /// Its points at rest in the world, and its cells; where its model has none, the surface's
  /// triangles. Made anew in each call.
  mesh::CellMesh cells(int i) const;

  int numAnatomy() const;
  /// Surface of a part of the anatomy in world, as it was read [m]; it never changes.
  mesh::SurfaceMesh anatomySurface(int i) const;

  /// One cycle of `dt` [s] during which instrument i moves from where it was to `poses[i]`, or, of
  /// an instrument with a proxy, as far towards it as the proxy may. The first cycle after
  /// construction or reset(), or in which an instrument is there again, takes `poses` as where it
  /// already was. Without poses an instrument is not there.
  /// Bad input (a pose that is not inReach(), dt not > 0) leaves the state and says so in the
  /// report; the wrench fades as after a failed solve.
  const StepResult& step(const std::vector<LinkPoses>& poses, double dt) noexcept;

  /// Asked now and then within every step, after its first iterations: true ends the step with the
  /// best state so far and the status `deadline`, whose wrench no hand is told. An empty one, as at
  /// first, never does. Results then depend on when it said so.
  void setInterrupt(solver::Interrupt interrupt);

  /// Back to the rest state at time 0.
  void reset();
  /// Whether instrument i, with its links at `poses`, would be clear of all tissue as it is now,
  /// and of the anatomy.
  bool isFree(int i, const LinkPoses& poses) const;
  /// Puts the points of an organ at `positions` with `velocities`, 3 x n [m], [m/s], from where it
  /// goes on without a past.
  /// @throws std::invalid_argument if the sizes are not this organ's or a number is not finite.
  void setPositions(int i, const Points& positions, const Points& velocities);

  double time() const;  ///< Simulated so far [s].

  /// All memory. To take it changes nothing.
  SimulatorState state() const;
  /// Goes on as the simulator would have whose state() it is.
  /// @throws std::invalid_argument that says what is wrong, if it is one of another scene, of other
  /// models or methods, or not whole; this simulator is then as it was.
  void restore(const SimulatorState& state);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate::sim
