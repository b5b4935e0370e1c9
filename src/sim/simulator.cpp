// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/sim/simulator.h"

#include <algorithm>
#include <stdexcept>

#include "palpate/tissue/method_facts.h"
#include "palpate/tissue/skips.h"
#include "simulator_impl.h"

namespace palpate::sim {
namespace {

void addOrgans(const tissue::TissueStep& cycle, StepReport* report) {
  tissue::mergeFigures(tissue::Over::kOrgans, cycle, report);
  for (const tissue::Skip& skip : tissue::skips()) {
    if (skip.count) report->skipped.*skip.count += skip.of(cycle);
  }
  Vec3 on_tissue = cycle.support_force + cycle.gravity_force + cycle.inertia_force;
  on_tissue += cycle.interaction_force;
  for (const tissue::TissueContact& c : cycle.contacts) on_tissue -= c.force_W;
  if (solver::balanced(cycle.status)) report->imbalance += on_tissue.norm();
}

}  // namespace

Simulator::Simulator(const scene::Scene& scene, const Progress& progress)
    : impl_(std::make_unique<Impl>(scene, progress)) {}
Simulator::~Simulator() = default;

const StepResult& Simulator::step(const std::vector<LinkPoses>& poses, double dt) noexcept {
  const double begin = steadySeconds();
  Impl& s = *impl_;
  if (!s.accepts(poses, dt)) {
    s.result.report.status = solver::SolveStatus::kNonFinite;
    if (dt > 0.0 && std::isfinite(dt)) s.fade(dt, false);
    return s.result;
  }
  s.result.clear(poses.size());

  s.moveBodies(s.follow(poses, dt));
  s.placeControlFrames();
  for (const scene::ModelPart& model : s.parts.models) {
    const std::uint64_t before = Impl::revision(*model.tissue);
    const tissue::TissueStep& cycle = model.tissue->step(s.bodies, dt);
    if (const std::vector<tissue::TissueStep>* organs = model.tissue->reports()) {
      for (const tissue::TissueStep& organ : *organs) addOrgans(organ, &s.result.report);
    } else {
      addOrgans(cycle, &s.result.report);
    }
    s.countMeshes(*model.tissue, before);
    s.sumWrenches(cycle, model.organs);
  }
  const bool told = s.isTold();
  s.anatomy.press(s.poses, &s.result);
  s.time += dt;
  s.finish(dt, told);
  PhaseTimes& phases = s.result.report.phases;
  phases[Phase::kOther] = steadySeconds() - begin - phases.cycle();
  return s.result;
}

void Simulator::setInterrupt(solver::Interrupt interrupt) {
  impl_->interrupt = std::move(interrupt);
  for (const scene::ModelPart& model : impl_->parts.models) {
    model.tissue->setInterrupt(impl_->interrupt ? &impl_->interrupt : nullptr);
  }
}

void Simulator::setMeshPace(const tissue::MeshPace& pace) {
  for (const scene::ModelPart& model : impl_->parts.models) model.tissue->setMeshPace(pace);
}

void Simulator::reset() {
  for (const scene::ModelPart& model : impl_->parts.models) model.tissue->reset();
  impl_->clear();
}

bool Simulator::isFree(int i, const LinkPoses& poses) const {
  return impl_->isFree(static_cast<std::size_t>(i), poses);
}

void Simulator::setPositions(int i, const Points& positions, const Points& velocities) {
  const scene::OrganHandle& place = impl_->parts.organs[static_cast<std::size_t>(i)];
  const auto fits = [&](const Points& given) {
    return given.cols() == place.surfaceState().positions.cols() && given.allFinite();
  };
  if (!fits(positions) || !fits(velocities)) {
    throw std::invalid_argument("these are not the points of organ " + organName(i) +
                                ", or not finite");
  }
  place.tissue->setPositions(place.organ, positions, velocities);
}

LinkPoses Simulator::linkPoses(int i, const Eigen::VectorXd& joints) const {
  LinkPoses poses;
  instrument(i).linkPoses(joints, &poses);
  const Pose X_WB = impl_->scene.instruments[i].base.pose();
  for (Pose& X : poses) X = X_WB * X;
  return poses;
}

const scene::Scene& Simulator::scene() const { return impl_->scene; }
const std::vector<std::string>& Simulator::warnings() const { return impl_->parts.warnings; }
const std::vector<std::string>& Simulator::notes() const { return impl_->parts.notes; }
int Simulator::numInstruments() const { return static_cast<int>(impl_->parts.instruments.size()); }
const instrument::Instrument& Simulator::instrument(int i) const {
  return impl_->parts.instruments[i];
}
int Simulator::controlLink(int i) const {
  return impl_->parts.control_links[static_cast<std::size_t>(i)];
}
int Simulator::numOrgans() const { return static_cast<int>(impl_->parts.organs.size()); }
const std::string& Simulator::organName(int i) const { return impl_->scene.organs[i].name; }
tissue::SurfaceState Simulator::surfaceState(int i) const {
  return impl_->parts.organs[i].surfaceState();
}
int Simulator::numAnatomy() const { return static_cast<int>(impl_->parts.anatomy.size()); }
mesh::SurfaceMesh Simulator::anatomySurface(int i) const {
  const scene::AnatomyPart& part = impl_->parts.anatomy[static_cast<std::size_t>(i)];
  return {part.X_WG * part.surface.points, part.surface.triangles};
}
const Points& Simulator::positions(int i) const { return surfaceState(i).positions; }
mesh::CellMesh Simulator::cells(int i) const {
  const scene::OrganHandle& place = impl_->parts.organs[i];
  mesh::CellMesh cells = place.tissue->cells(place.organ);
  if (cells.numCells() == 0) cells.cells = place.surfaceState().triangles;
  return cells;
}
std::vector<std::string> Simulator::methods(int i) const {
  const scene::OrganHandle& place = impl_->parts.organs[i];
  return place.tissue->methods(place.organ);
}
bool Simulator::stepsMayGrow() const {
  for (int i = 0; i < numOrgans(); ++i) {
    if (methods(i).empty()) return false;
    for (const std::string& method : methods(i)) {
      if (tissue::methodFacts(method).explicit_steps) return false;
    }
  }
  return true;
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
