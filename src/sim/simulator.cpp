// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/sim/simulator.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "palpate/contact/obstacle.h"
#include "palpate/haptics/wrench_fade.h"
#include "palpate/scene/loaded_scene.h"
#include "palpate/tissue/method_facts.h"
#include "palpate/tissue/skips.h"

namespace palpate::sim {
namespace {

bool allFinite(const std::vector<LinkPoses>& poses) {
  for (const LinkPoses& links : poses) {
    for (const Pose& X : links) {
      if (!X.matrix().allFinite()) return false;
    }
  }
  return true;
}

void addModel(const tissue::TissueStep& cycle, StepReport* report) {
  tissue::mergeFigures(tissue::Over::kOrgans, cycle, report);
  for (const tissue::Skip& skip : tissue::skips()) {
    if (skip.count) report->skipped.*skip.count += skip.of(cycle);
  }
  Vec3 on_tissue = cycle.support_force + cycle.gravity_force + cycle.inertia_force;
  for (const tissue::TissueContact& c : cycle.contacts) on_tissue -= c.force_W;
  if (cycle.ok()) report->imbalance += on_tissue.norm();
}

}  // namespace

struct Simulator::Impl {
  scene::Scene scene;
  scene::LoadedScene loaded;
  std::vector<contact::Obstacle> bodies;
  std::vector<std::pair<int, int>> body_source;  // instrument, index into its bodies()
  std::vector<LinkPoses> poses;                  // where the tools are; empty: nowhere yet
  StepResult result;
  std::vector<haptics::WrenchFade> fades;  // one an instrument
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
    fades.assign(loaded.instruments.size(), haptics::WrenchFade(scene.rates.ramp, 1.0));
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

  void sumWrenches(const tissue::TissueStep& cycle, const std::vector<int>& organs) {
    for (const tissue::TissueContact& c : cycle.contacts) {
      InstrumentResult& tool = result.instruments[c.instrument];
      tool.spatial += Wrench{c.force_W, (c.p_W - tool.X_WC.translation()).cross(c.force_W)};
      tool.max_penetration = std::max(tool.max_penetration, c.penetration);
      ++tool.contacts;
      const int organ = organs[static_cast<std::size_t>(c.organ)];
      result.contacts.push_back({c.instrument, organ, c.p_W, c.force_W});
    }
  }

  /// The hand feels solved states only; after a cycle that failed what it felt fades.
  void fade(double dt) {
    for (std::size_t i = 0; i < fades.size(); ++i) {
      InstrumentResult& tool = result.instruments[i];
      tool.spatial = fades[i].update(tool.spatial, result.report.usable(), dt);
      tool.solved = fades[i].held();
    }
  }

  void finish(double dt) {
    fade(dt);
    for (const InstrumentResult& tool : result.instruments) {
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
    if (dt > 0.0 && std::isfinite(dt)) s.fade(dt);
    return s.result;
  }
  s.result.clear(poses.size());

  s.moveBodies(poses);
  s.placeControlFrames();
  for (const scene::LoadedModel& model : s.loaded.models) {
    const tissue::TissueStep& cycle = model.tissue->step(s.bodies, dt);
    addModel(cycle, &s.result.report);
    s.sumWrenches(cycle, model.organs);
  }
  s.time += dt;
  s.finish(dt);
  PhaseTimes& phases = s.result.report.phases;
  phases[Phase::kOther] = steadySeconds() - begin - phases.cycle();
  return s.result;
}

void Simulator::setInterrupt(solver::Interrupt interrupt) {
  impl_->interrupt = std::move(interrupt);
  for (const scene::LoadedModel& model : impl_->loaded.models) {
    model.tissue->setInterrupt(impl_->interrupt ? &impl_->interrupt : nullptr);
  }
}

void Simulator::reset() {
  for (const scene::LoadedModel& model : impl_->loaded.models) model.tissue->reset();
  impl_->clear();
}

void Simulator::place(int i, const Points& positions, const Points& velocities) {
  const scene::OrganPlace& place = impl_->loaded.organs[static_cast<std::size_t>(i)];
  const auto fits = [&](const Points& given) {
    return given.cols() == place.shape().positions.cols() && given.allFinite();
  };
  if (!fits(positions) || !fits(velocities)) {
    throw std::invalid_argument("these are not the points of organ " + organName(i) +
                                ", or not finite");
  }
  place.tissue->place(place.organ, positions, velocities);
}

SimulatorState Simulator::state() const {
  SimulatorState state;
  state.time = impl_->time;
  for (const scene::OrganPlace& place : impl_->loaded.organs) {
    state.positions.push_back(place.shape().positions);
    state.velocities.push_back(place.shape().velocities);
  }
  return state;
}

void Simulator::restore(const SimulatorState& state) {
  const std::vector<scene::OrganPlace>& organs = impl_->loaded.organs;
  const auto fits = [](const Points& given, const Points& own) {
    return given.cols() == own.cols() && given.allFinite();
  };
  bool ok = std::isfinite(state.time) && state.positions.size() == organs.size() &&
            state.velocities.size() == organs.size();
  for (std::size_t i = 0; ok && i < organs.size(); ++i) {
    ok = fits(state.positions[i], organs[i].shape().positions) &&
         fits(state.velocities[i], organs[i].shape().positions);
  }
  if (!ok) throw std::invalid_argument("the state is not one of this scene, or not finite");
  impl_->clear();
  impl_->time = state.time;
  for (std::size_t i = 0; i < organs.size(); ++i) {
    organs[i].tissue->place(organs[i].organ, state.positions[i], state.velocities[i]);
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
int Simulator::numOrgans() const { return static_cast<int>(impl_->loaded.organs.size()); }
const std::string& Simulator::organName(int i) const { return impl_->scene.organs[i].name; }
tissue::Shape Simulator::shape(int i) const { return impl_->loaded.organs[i].shape(); }
const Points& Simulator::positions(int i) const { return shape(i).positions; }
mesh::CellMesh Simulator::cells(int i) const {
  const scene::OrganPlace& place = impl_->loaded.organs[i];
  mesh::CellMesh cells = place.tissue->cells(place.organ);
  if (cells.numCells() == 0) cells.cells = place.shape().triangles;
  return cells;
}
std::vector<std::string> Simulator::methods(int i) const {
  return impl_->loaded.organs[i].tissue->methods();
}
bool Simulator::wantsFastBlas() const {
  for (int i = 0; i < numOrgans(); ++i) {
    for (const std::string& method : methods(i)) {
      if (tissue::methodFacts(method).wants_fast_blas) return true;
    }
  }
  return false;
}

}  // namespace palpate::sim
