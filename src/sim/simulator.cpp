// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/sim/simulator.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "palpate/contact/signed_distance.h"
#include "palpate/scene/loaded_scene.h"
#include "palpate/tissue/method_facts.h"
#include "palpate/tissue/skips.h"

namespace palpate::sim {
namespace {

constexpr double kDecayTime = 0.05;  // of the wrench after a failed solve [s]

bool allFinite(const std::vector<LinkPoses>& poses) {
  for (const LinkPoses& links : poses) {
    for (const Pose& X : links) {
      if (!X.matrix().allFinite()) return false;
    }
  }
  return true;
}

void addOrgan(const tissue::TissueStep& organ, StepReport* report) {
  tissue::mergeFigures(tissue::Over::kOrgans, organ, report);
  for (const tissue::Skip& skip : tissue::skips()) {
    if (skip.count) report->skipped.*skip.count += skip.of(organ);
  }
  Vec3 on_tissue = organ.support_force + organ.gravity_force + organ.inertia_force;
  for (const tissue::TissueContact& c : organ.contacts) on_tissue -= c.force_W;
  if (organ.ok()) report->imbalance += on_tissue.norm();
}

}  // namespace

struct Simulator::Impl {
  scene::Scene scene;
  scene::LoadedScene loaded;
  std::vector<tissue::ToolBody> bodies;
  std::vector<std::pair<int, int>> body_source;  // instrument, index into its bodies()
  std::vector<LinkPoses> poses;                  // where the tools are; empty: nowhere yet
  StepResult result;
  std::vector<Wrench> last;  // what the hands felt a cycle before
  double time = 0.0;
  solver::Interrupt interrupt;

  Impl(const scene::Scene& s, const Progress& progress)
      : scene(s), loaded(scene::loadScene(s, progress)) {
    for (std::size_t i = 0; i < loaded.instruments.size(); ++i) {
      const auto& shapes = loaded.instruments[i].bodies();
      for (std::size_t b = 0; b < shapes.size(); ++b) {
        bodies.push_back({&shapes[b].geometry, static_cast<int>(i), Pose(), Pose()});
        body_source.emplace_back(i, b);
      }
    }
    clear();
  }

  void clear() {
    time = 0.0;
    poses.clear();
    result.clear(loaded.instruments.size());
  }

  bool accepts(const std::vector<LinkPoses>& next, double dt) const {
    if (!(dt > 0.0) || !std::isfinite(dt) || next.size() != loaded.instruments.size()) return false;
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (next[i].size() != loaded.instruments[i].linkNames().size()) return false;
    }
    return allFinite(next);
  }

  void moveBodies(const std::vector<LinkPoses>& next) {
    const std::vector<LinkPoses>& from = poses.empty() ? next : poses;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      const auto [i, b] = body_source[k];
      const instrument::CollisionBody& shape = loaded.instruments[i].bodies()[b];
      bodies[k].X_WG_begin = from[i][shape.link] * shape.X_LG;
      bodies[k].X_WG_end = next[i][shape.link] * shape.X_LG;
    }
    poses = next;
  }

  void placeControlFrames() {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      result.instruments[i].X_WC = poses[i][loaded.control_links[i]];
    }
  }

  void sumWrenches(const tissue::TissueStep& organ, int organ_index) {
    for (const tissue::TissueContact& c : organ.contacts) {
      InstrumentResult& tool = result.instruments[c.instrument];
      tool.spatial += Wrench{c.force_W, (c.p_W - tool.X_WC.translation()).cross(c.force_W)};
      tool.max_penetration = std::max(tool.max_penetration, c.penetration);
      ++tool.contacts;
      result.contacts.push_back({c.instrument, organ_index, c.p_W, c.force_W});
    }
  }

  void finish(double dt) {
    for (std::size_t i = 0; i < result.instruments.size(); ++i) {
      InstrumentResult& tool = result.instruments[i];
      // The hand feels solved states only; after a failed one what it felt fades.
      if (!result.report.usable()) tool.spatial = std::exp(-dt / kDecayTime) * last[i];
      const Mat3 R_CW = tool.X_WC.linear().transpose();
      tool.body = {R_CW * tool.spatial.force, R_CW * tool.spatial.torque};
      result.report.contacts += tool.contacts;
      result.report.max_penetration = std::max(result.report.max_penetration, tool.max_penetration);
    }
    result.report.time = time;
    result.report.step = dt;
  }
};

Simulator::Simulator(const scene::Scene& scene, const Progress& progress)
    : impl_(std::make_unique<Impl>(scene, progress)) {}
Simulator::~Simulator() = default;

const StepResult& Simulator::step(const std::vector<LinkPoses>& poses, double dt) noexcept {
  const double begin = steadySeconds();
  Impl& s = *impl_;
  if (!s.accepts(poses, dt)) {
    s.result.report.status = solver::SolveStatus::kNonFinite;
    return s.result;
  }
  s.last.clear();
  for (const InstrumentResult& tool : s.result.instruments) s.last.push_back(tool.spatial);
  s.result.clear(poses.size());

  s.moveBodies(poses);
  s.placeControlFrames();
  for (std::size_t i = 0; i < s.loaded.tissues.size(); ++i) {
    const tissue::TissueStep& organ = s.loaded.tissues[i]->step(s.bodies, dt);
    addOrgan(organ, &s.result.report);
    s.sumWrenches(organ, static_cast<int>(i));
  }
  s.time += dt;
  s.finish(dt);
  PhaseTimes& phases = s.result.report.phases;
  phases[Phase::kOther] = steadySeconds() - begin - phases.cycle();
  return s.result;
}

void Simulator::setInterrupt(solver::Interrupt interrupt) {
  impl_->interrupt = std::move(interrupt);
  for (const auto& tissue : impl_->loaded.tissues) {
    tissue->setInterrupt(impl_->interrupt ? &impl_->interrupt : nullptr);
  }
}

void Simulator::reset() {
  for (const auto& tissue : impl_->loaded.tissues) tissue->reset();
  impl_->clear();
}

SimulatorState Simulator::state() const {
  SimulatorState state;
  state.time = impl_->time;
  for (const auto& tissue : impl_->loaded.tissues) {
    state.positions.push_back(tissue->positions());
    state.velocities.push_back(tissue->velocities());
  }
  return state;
}

void Simulator::restore(const SimulatorState& state) {
  const auto& tissues = impl_->loaded.tissues;
  const auto fits = [](const Points& given, const Points& own) {
    return given.cols() == own.cols() && given.allFinite();
  };
  bool ok = std::isfinite(state.time) && state.positions.size() == tissues.size() &&
            state.velocities.size() == tissues.size();
  for (std::size_t i = 0; ok && i < tissues.size(); ++i) {
    ok = fits(state.positions[i], tissues[i]->positions()) &&
         fits(state.velocities[i], tissues[i]->positions());
  }
  if (!ok) throw std::invalid_argument("the state is not one of this scene, or not finite");
  impl_->clear();
  impl_->time = state.time;
  for (std::size_t i = 0; i < tissues.size(); ++i) {
    tissues[i]->restore(state.positions[i], state.velocities[i]);
  }
}

LinkPoses Simulator::linkPoses(int i, const Eigen::VectorXd& joints) const {
  LinkPoses poses;
  instrument(i).linkPoses(joints, &poses);
  const Pose X_WB = impl_->scene.instruments[i].base.pose();
  for (Pose& X : poses) X = X_WB * X;
  return poses;
}

const scene::Scene& Simulator::scene() const { return impl_->scene; }
const std::vector<std::string>& Simulator::warnings() const { return impl_->loaded.warnings; }
const std::vector<std::string>& Simulator::notes() const { return impl_->loaded.notes; }
int Simulator::numInstruments() const { return static_cast<int>(impl_->loaded.instruments.size()); }
const instrument::Instrument& Simulator::instrument(int i) const {
  return impl_->loaded.instruments[i];
}
int Simulator::numOrgans() const { return static_cast<int>(impl_->loaded.tissues.size()); }
const std::string& Simulator::organName(int i) const { return impl_->scene.organs[i].name; }
std::vector<std::string> Simulator::methods(int i) const {
  return impl_->loaded.tissues[i]->methods();
}
bool Simulator::wantsFastBlas() const {
  for (int i = 0; i < numOrgans(); ++i) {
    for (const std::string& method : methods(i)) {
      if (tissue::methodFacts(method).wants_fast_blas) return true;
    }
  }
  return false;
}
const Points& Simulator::restPositions(int i) const {
  return impl_->loaded.tissues[i]->restMesh().points;
}
const Points& Simulator::positions(int i) const { return impl_->loaded.tissues[i]->positions(); }
const mesh::TetMesh& Simulator::organMesh(int i) const {
  return impl_->loaded.tissues[i]->restMesh();
}
const Eigen::Matrix3Xi& Simulator::surfaceTriangles(int i) const {
  return impl_->loaded.tissues[i]->surfaceTriangles();
}

}  // namespace palpate::sim
