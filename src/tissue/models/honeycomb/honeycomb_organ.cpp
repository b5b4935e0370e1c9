// SPDX-License-Identifier: GPL-3.0-or-later
#include "honeycomb_organ.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "tissue/touch/stage_limits.h"

namespace palpate::tissue {
namespace {

constexpr int kWavesOnTheWay = 10;   // of a stage that is not the last of a cycle
constexpr int kStagesInsideOut = 6;  // in a row, after which a cycle is given up
constexpr int kMaxLatticeSearches = 3;
constexpr int kEquilibriumWaves = 100;  // under gravity, times those of a cycle

Points weightsOf(const HoneycombParts& parts, const Vec3& gravity) {
  Points weights(3, parts.lattice.numCells());
  for (int c = 0; c < parts.lattice.numCells(); ++c) {
    const double mass = parts.density[static_cast<std::size_t>(c)] * parts.lattice.volume();
    weights.col(c) = mass * (parts.X_WO.linear().transpose() * gravity);
  }
  return weights;
}

double sizeOf(const Points& X) { return (X.rowwise().maxCoeff() - X.rowwise().minCoeff()).norm(); }

// By which the threshold of motion is one of forces: of what no side is softer than [N/m].
double softest(const CellFabric& fabric) { return fabric.diagonal.minCoeff(); }

// What the surface is borne by, for contact: masses and moduli around corners.
void setBearing(const HoneycombParts& parts, contact::ContactPotential* contact) {
  const CellLattice& lattice = parts.lattice;
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(lattice.corners.cols());
  Eigen::VectorXd bearing = masses;
  for (int c = 0; c < lattice.numCells(); ++c) {
    const auto number = static_cast<std::size_t>(c);
    for (const int i : lattice.cells[number].corners) {
      masses[i] += 0.125 * parts.density[number] * lattice.volume();
      bearing[i] =
          std::max(bearing[i], 3.0 * parts.shear_modulus[number] / lattice.size.maxCoeff());
    }
  }
  contact->setBearing(parts.free, masses, bearing);
}

}  // namespace

HoneycombOrgan::HoneycombOrgan(HoneycombParts parts, const HoneycombSettings& settings,
                               const ModelSettings& scene)
    : parts_(std::move(parts)),
      settings_(settings),
      held_(heldSides(parts_.lattice, parts_.free)),
      fabric_(makeCellFabric(parts_.lattice, held_, parts_.shear_modulus)),
      weight_(weightsOf(parts_, scene.gravity)),
      balance_(parts_.lattice, fabric_, held_, weight_, settings.volume == "exact"),
      map_(parts_.lattice, held_, parts_.free, parts_.X_WO),
      tool_contact_(map_.rest(), parts_.lattice.triangles, scene),
      rest_(Rest::kMotion * sizeOf(map_.rest()), scene.skip.sleeping),
      tolerance_(settings.threshold * softest(fabric_)),
      solver_(balance_, map_, tool_contact_.contact, settings, tolerance_) {
  setBearing(parts_, &tool_contact_.contact);
  findEquilibrium();
  HoneycombOrgan::reset();
}

void HoneycombOrgan::findEquilibrium() {
  equilibrium_ = balance_.rest();
  const CellSolve solve =
      solver_.solve(kEquilibriumWaves * settings_.max_sweeps, nullptr, &equilibrium_, true);
  if (solve.status != solver::SolveStatus::kConverged || balance_.leastRatio(equilibrium_) <= 0.0) {
    throw std::runtime_error(
        "no equilibrium of the honeycomb under gravity: it is too soft, too "
        "heavy, or held too little");
  }
}

mesh::CellMesh HoneycombOrgan::cells(int) const {
  mesh::CellMesh cells;
  cells.points = map_.rest();
  cells.cells = parts_.lattice.hexahedra();
  return cells;
}

std::vector<std::string> HoneycombOrgan::notes() const {
  const Vec3 mm = 1e3 * parts_.lattice.size;
  const auto text = [](double x) {
    std::string s = std::to_string(x);
    return s.substr(0, s.find('.') + 3);
  };
  return {
      "honeycomb: " + std::to_string(parts_.lattice.numCells()) + " cells of " + text(mm.x()) +
      " x " + text(mm.y()) + " x " + text(mm.z()) +
      " mm, incompressible, quasi-static: damping and Poisson's ratio are not used, and only tools "
      "and anatomy touch it"};
}

const TissueStep& HoneycombOrgan::step(const std::vector<contact::Obstacle>& obstacles, double dt) {
  out_.clear();
  tool_contact_.begin(obstacles, x_, v_, dt, &out_);
  if (rest_.sleeps(tool_contact_)) {
    rest_.report(&out_);
    return out_;
  }
  rest_.begin(x_);
  x_begin_ = x_;
  begin_state_ = state_;
  begin_memory_ = solver_.waves().memory();
  out_.tolerance = tolerance_;
  solveStages();
  if (isPierced()) out_.status = solver::SolveStatus::kLineSearchFailed;
  out_.min_jacobian = balance_.leastRatio(state_);
  if (!solver::usable(out_.status) || !x_.allFinite() || !(out_.min_jacobian > 0.0)) {
    out_.recover(Recovery::kRolledBack);
    state_ = begin_state_;
    solver_.waves().remember(begin_memory_);
    x_ = x_begin_;
    v_.setZero();
    tool_contact_.contact.forget();
    tool_contact_.inside_tools.invalidate();
    out_.status = std::max(out_.status, solver::SolveStatus::kLineSearchFailed);
    return out_;
  }
  v_ = (x_ - x_begin_) / dt;
  reportForces();  // contact has not yet remembered this step
  tool_contact_.endStep(x_);
  if (out_.ok()) tool_contact_.contact.learn(x_, dt);
  tool_contact_.report(x_, &out_);
  tool_contact_.countInactive(&out_);
  rest_.remember(out_);
  return out_;
}

// Whether a tool is deeper in the surface than one may get. Held sides bear any force, so that the
// solve sees nothing wrong in it.
bool HoneycombOrgan::isPierced() {
  tool_contact_.contact.collect(x_, &contacts_);
  return std::any_of(contacts_.begin(), contacts_.end(), [](const contact::Contact& c) {
    return c.touch.penetration() > c.touch.room;
  });
}

void HoneycombOrgan::add(const CellSolve& solve) {
  out_.status = solve.status;
  out_.newton_iterations += solve.waves;
  out_.linear_iterations += solve.cells;
  out_.residual = solve.residual;
  map_.place(state_, &x_);
}

// The tools go on as far as the tissue can follow, it is solved, and so on to the end. Cells that
// they keep turned inside out do not come back: such a cycle will be rolled back.
void HoneycombOrgan::solveStages() {
  tool_contact_.moveTo(0.0);
  tool_contact_.tool_path.beginStep(x_);
  out_.sweep_stages = 0;
  const auto solve = [this](int waves) {
    const PhaseTimer timer(&out_.phases, Phase::kLinearSolve);
    for (int search = 0; search < kMaxLatticeSearches; ++search) {
      add(solver_.solve(waves, interrupt_, &state_));
      if (tool_contact_.tool_path.candidatesHold(x_)) break;
      tool_contact_.tool_path.search(x_);
    }
  };
  int inside_out = 0;
  for (double s = 0.0; s < 1.0;) {
    const bool late = s > 0.0 && solver::isInterrupted(interrupt_);
    s = late ? 1.0 : tool_contact_.tool_path.next(x_, s, 1.0);
    if (late) tool_contact_.inside_tools.invalidate();
    tool_contact_.moveTo(s);
    ++out_.sweep_stages;
    solve(s < 1.0 ? std::min(kWavesOnTheWay, settings_.max_sweeps) : settings_.max_sweeps);
    if (!solver::usable(out_.status)) return;
    inside_out = balance_.leastRatio(state_) > 0.0 ? 0 : inside_out + 1;
    if (inside_out == kStagesInsideOut) return;
  }
  const int most =
      tool_contact_.contact.hasFriction() ? kMaxFrictionAugmentations : kMaxAugmentations;
  for (int k = 0; k < most && out_.ok() && !tool_contact_.contact.augmentationConverged(x_); ++k) {
    tool_contact_.contact.augment(x_);
    solve(settings_.max_sweeps);
  }
  out_.satisfied = out_.newton_iterations == 0 && out_.ok();
}

void HoneycombOrgan::reportForces() {
  out_.elastic_energy = balance_.elasticEnergy(state_);
  double volume_error = 0.0;
  const double unbalanced = solver_.unbalanced(state_, true, &volume_error);
  if (rest_.isStill(x_, tool_contact_, out_) && unbalanced <= tolerance_) {
    rest_.fallAsleep();
    v_.setZero();
  }
  Vec3 support = Vec3::Zero();
  for (int s = 0; s < parts_.lattice.numSides(); ++s) {
    const auto number = static_cast<std::size_t>(s);
    const int axis = parts_.lattice.sides[number].axis;
    support[axis] -= held_.along_normal[number] ? balance_.force(state_, s) : 0.0;
    support[axis] -= fabric_.shear_to_held[s] * state_.sides[s];
  }
  solver_.contactForces(x_, &f_);
  out_.support_force = map_.frame() * support - map_.borne(f_);
  out_.gravity_force = map_.frame() * weight_.rowwise().sum();
}

void HoneycombOrgan::reset() {
  state_ = equilibrium_;
  solver_.waves().forget();
  map_.place(state_, &x_);
  v_.setZero(3, x_.cols());
  tool_contact_.forget();
  rest_.wake();
}

void HoneycombOrgan::setPositions(int, const Points& positions, const Points& velocities) {
  map_.fit(positions, &state_);
  state_.pressures = equilibrium_.pressures;
  solver_.waves().forget();
  map_.place(state_, &x_);
  v_ = velocities;
  tool_contact_.forget();
  rest_.wake();
}

std::string HoneycombOrgan::kind() const {
  return "honeycomb, " + std::to_string(parts_.lattice.numCells()) + " cells";
}

State HoneycombOrgan::state() const {
  StateWriter out;
  out.put(state_.sides);
  out.put(state_.pressures);
  out.put(state_.turns);
  out.put(v_);
  out.put(solver_.waves().memory());
  tool_contact_.save(&out);
  rest_.save(&out);
  return {kind(), out.bytes()};
}

void HoneycombOrgan::restore(const State& state) {
  checkKind(state, kind());
  StateReader in(state.bytes);
  in.getSame(&state_.sides);
  in.getSame(&state_.pressures);
  in.getSame(&state_.turns);
  in.getSame(&v_);
  std::vector<double> pending;
  in.get(&pending);
  if (pending.size() != parts_.lattice.cells.size()) StateReader::fail();
  solver_.waves().remember(pending);
  tool_contact_.restore(&in);
  rest_.restore(&in);
  in.finish();
  map_.place(state_, &x_);
}

}  // namespace palpate::tissue
