// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem_organ.h"

#include <cmath>

#include "tissue/methods/method_list.h"

namespace palpate::tissue {
namespace {

// Least det F after a mesh adaptation over the value before [-].
constexpr double kMinKeptJacobianRatio = 0.5;
// Bounds of det F at rest without tools: absolute [-], and over the value in equilibrium [-].
constexpr double kMinRestJacobian = 0.1, kMinRestJacobianRatio = 0.5;
// Displacement per cycle without progress, over the body's size [-].
constexpr double kMinProgressRatio = 1e-4;
// Least increase of det F that counts as progress [-].
constexpr double kMinJacobianGain = 0.01;

Drive driveBy(const fem::EnergyTerm* load) {
  Drive drive;
  if (load != nullptr) drive.loads.push_back(load);
  return drive;
}

}  // namespace

FemOrgan::FemOrgan(const mesh::TetMesh& mesh, const fem::Composition& composition,
                   const Surroundings& surroundings, const FemSettings& settings, ThreadPool* pool,
                   const Eigen::Matrix3Xi& surface, const OwnParts& own)
    : own_load_(own.load),
      body_(mesh, composition, surroundings, settings, pool, driveBy(own_load_.get()),
            own.elasticity, surface.cols() > 0 ? surface : own.surface, own.samples),
      method_(own.method ? own.method(&body_) : makeStepMethod(settings.method, &body_)),
      rest_((body_.elasticity->viscous() ? Rest::kMotionCreeping : Rest::kMotion) * body_.size,
            settings.skip.sleeping && !body_.surroundings.moves()),
      equilibrium_(own.start.cols() > 0 ? own.start : body_.mesh.points),
      own_method_(own.method != nullptr),
      own_start_(own.start.cols() > 0),
      own_notes_(own.notes) {}

void FemOrgan::findEquilibrium() {
  if (!own_start_) {
    equilibrium_ = equilibriumUnderLoads(&body_);
    body_.surroundings.seal(equilibrium_);
    method_->moveToEquilibrium(&equilibrium_);
  }
  reset();
}

bool FemOrgan::canGoOnFrom(const FemOrgan& old, const mesh::MeshChange& change) const {
  const Points x = change.interpolate(old.body_.x);
  const double before = old.body_.elasticity->minJacobian(old.body_.x);
  const double now = body_.elasticity->minJacobian(x);
  return now >= (before > 0.0 ? kMinKeptJacobianRatio * before : before) &&
         std::isfinite(body_.elasticity->energy(x));
}

void FemOrgan::goOnFrom(const FemOrgan& old, const mesh::MeshChange& change) {
  body_.goOnFrom(old.body_, change);
  method_->goOnFrom(*old.method_, change);
  rest_.wake();
  backoff_ = FailureBackoff();
  stuck_at_ = kNotStuck;
  was_inverted_ = old.was_inverted_;
  out_.clear();
}

std::vector<std::string> FemOrgan::methods(int) const {
  if (own_method_) return {};
  return {body_.method};
}

std::vector<std::string> FemOrgan::notes() const {
  std::vector<std::string> all = own_notes_;
  if (!body_.method_note.empty()) all.push_back(body_.method_note);
  return all;
}

void FemOrgan::reset() {
  body_.surroundings.reset();
  setPositions(0, equilibrium_, Points::Zero(3, equilibrium_.cols()));
}

void FemOrgan::setPositions(int, const Points& positions, const Points& velocities) {
  put(positions, velocities);
  method_->prepare(body_.settings.step);
}

void FemOrgan::prepareAt(const Points& x, double dt) {
  put(x, Points::Zero(3, x.cols()));
  method_->prepare(dt);
}

void FemOrgan::put(const Points& positions, const Points& velocities) {
  body_.startAt(positions, velocities);
  method_->restart();
  backoff_ = FailureBackoff();
  stuck_at_ = kNotStuck;
  was_inverted_ = false;
  rest_.wake();
  out_.clear();
}

State FemOrgan::state() const {
  StateWriter out;
  body_.save(&out);
  method_->save(&out);
  rest_.save(&out);
  backoff_.save(&out);
  out.put(stuck_at_);
  out.put(was_inverted_);
  return {stateKind(body_.settings, body_.x.cols()), out.bytes()};
}

void FemOrgan::restore(const State& state) {
  checkKind(state, stateKind(body_.settings, body_.x.cols()));
  StateReader in(state.bytes);
  body_.restore(&in);
  method_->restore(&in);
  rest_.restore(&in);
  backoff_.restore(&in);
  in.get(&stuck_at_);
  in.get(&was_inverted_);
  if (!std::isfinite(stuck_at_)) StateReader::fail();
  in.finish();
  out_.clear();
}

void FemOrgan::begin(const std::vector<contact::Obstacle>& obstacles, double dt) {
  out_.clear();
  stuck_ = false;
  body_.min_jacobian.reset();
  body_.surroundings.beginCycle(dt);
  body_.tool_contact.begin(obstacles, body_.x, body_.v, dt, &out_);
  contact_force_ = body_.contact_force;
  support_force_ = body_.support_force;
}

void FemOrgan::stepAlone(double dt) { solveCycle(alone_, method_.get(), dt, &out_); }

void FemOrgan::endSolved(const TissueStep& solved, bool at_rest, CycleSolver* solver,
                         std::size_t member) {
  takeFigures(solved);
  if (at_rest) fallAsleep();
  solver->reportForcesOn(member, &out_);
  reportSolved();
  finishCycle();
}

void FemOrgan::endReset(const TissueStep& solved, solver::SolveStatus why) {
  takeFigures(solved);
  resetToEquilibrium(why);
}

void FemOrgan::endFailed(const TissueStep& failed, bool for_good) {
  takeFigures(failed);
  fail();
  if (for_good || isOutsideOfLaw()) return resetToEquilibrium(failureHere());
  finishCycle();
}

// Takes over the group's figures; one member reports iterations and times.
void FemOrgan::takeFigures(const TissueStep& solved) {
  out_.status = solved.status;
  out_.sweep_stages = solved.sweep_stages;
  out_.recovery = solved.recovery;
  out_.time_steps = solved.time_steps;
  out_.residual = solved.residual;
  out_.tolerance = solved.tolerance;
  out_.satisfied = solved.satisfied;
}

void FemOrgan::addWork(const TissueStep& of_group) {
  out_.newton_iterations += of_group.newton_iterations;
  out_.linear_iterations += of_group.linear_iterations;
  out_.kept_stiffnesses += of_group.kept_stiffnesses;
  out_.phases += of_group.phases;
}

void FemOrgan::reportSolved() {
  if (!stuck_) {
    backoff_.solved();
    stuck_at_ = kNotStuck;
  }
  out_.gravity_force = body_.weight;
  out_.inviscid_solids = body_.inviscid_solids;
  body_.tool_contact.countInactive(&out_);
  if (out_.status != solver::SolveStatus::kDeadline) return;
  // Forces of a cut cycle are not in equilibrium, and must not set the tolerance.
  body_.contact_force = contact_force_;
  body_.support_force = support_force_;
}

// Whether the body rests with nearly inverted elements, in a false equilibrium after a tool's jump.
// Uses det F everywhere in an element: corners of quadratic ones invert between integration points.
bool FemOrgan::isCrushed() {
  const double now = body_.elasticity->minJacobianWithin(body_.x);
  return now < kMinRestJacobian &&
         now < kMinRestJacobianRatio * body_.elasticity->minJacobianWithin(equilibrium_);
}

// Largest displacement in this cycle relative to that of the supports [m].
double FemOrgan::wayOfShape() const {
  return rest_.way(body_.x, body_.surroundings.commonWay(1.0) - body_.surroundings.commonWay(0.0));
}

// Whether inverted elements persist without progress: small displacements, no rest, constant det F.
bool FemOrgan::isStuck(const TissueStep& cycle) {
  if (cycle.status == solver::SolveStatus::kDeadline || cycle.newton_iterations == 0) return false;
  if (wayOfShape() > kMinProgressRatio * body_.size) return false;
  const double now = body_.elasticity->minJacobianWithin(body_.x);
  if (now > 0.0) return false;
  if (stuck_at_ == kNotStuck) {
    stuck_at_ = now;
  } else if (now > stuck_at_ + kMinJacobianGain * std::max(1.0, -stuck_at_)) {
    stuck_at_ = now;
    backoff_.solved();
  }
  return true;
}

bool FemOrgan::shouldReset(const TissueStep& cycle, bool at_rest) {
  const bool before = was_inverted_;
  if (at_rest) {
    was_inverted_ = isCrushed();
    return was_inverted_ && !before;
  }
  stuck_ = isStuck(cycle);
  if (!stuck_) return false;
  backoff_.failed(solver::SolveStatus::kInverted);
  was_inverted_ |= backoff_.fails();
  return was_inverted_ && !before;
}

// Whether energy or forces are not finite or above kMostForce, after positions were set, so that no
// step can solve.
bool FemOrgan::isOutsideOfLaw() const {
  if (out_.status != solver::SolveStatus::kNonFinite) {
    return !std::isfinite(body_.elasticity->energy(body_.x));
  }
  Points g;
  const double energy = body_.elasticity->gradient(body_.x, &g);
  return !std::isfinite(energy) || !(g.norm() <= FemBody::kMostForce);
}

// Status to report for a reset.
solver::SolveStatus FemOrgan::failureHere() const {
  return isOutsideOfLaw() ? solver::SolveStatus::kInverted : out_.status;
}

// Resets the body to its equilibrium, displaced with its supports, with zero velocity.
void FemOrgan::resetToEquilibrium(solver::SolveStatus why) {
  const StepFigures figures = out_;
  const bool was_inverted = was_inverted_;
  body_.surroundings.rest();
  put(equilibrium_.colwise() + body_.surroundings.commonWay(1.0),
      Points::Zero(3, equilibrium_.cols()));
  was_inverted_ = was_inverted;
  static_cast<StepFigures&>(out_) = figures;
  out_.recovery = static_cast<int>(Recovery::kPutBack);
  Points g;
  body_.elasticity->gradient(body_.x, &g);
  body_.addLoads(body_.x, &g);
  out_.residual = g.cwiseProduct(body_.free).norm();
  body_.reportSupport(g, &out_);
  reportSolved();
  finishCycle();
  out_.status = why;
}

void FemOrgan::fallAsleep() {
  rest_.fallAsleep();
  stop();
}

// Rolls back. Tools have moved, so they may be inside; a deadline is no failure.
void FemOrgan::fail() {
  out_.recover(Recovery::kRolledBack);
  if (out_.status != solver::SolveStatus::kDeadline) backoff_.failed(out_.status);
  stop();
  body_.tool_contact.inside_tools.invalidate();
}

void FemOrgan::stayFrozen(solver::SolveStatus why) {
  out_.status = why;
  if (!isFailing()) stop();
  out_.recover(Recovery::kFrozen);
  finishCycle();
}

void FemOrgan::stop() {
  body_.v.setZero();
  method_->stop();
}

// Advances the simulated time, and reports the state at the cycle's end.
void FemOrgan::finishCycle() {
  body_.surroundings.endCycle();
  const PhaseTimer timer(&out_.phases, Phase::kForces);
  if (out_.time_steps > 1) out_.recover(Recovery::kShorterSteps);
  out_.min_jacobian =
      body_.min_jacobian ? *body_.min_jacobian : body_.elasticity->minJacobian(body_.x);
  out_.status = solver::judged(out_.status, out_.min_jacobian);
  out_.kinetic_energy =
      0.5 * body_.v.colwise().squaredNorm().transpose().cwiseProduct(method_->masses()).sum();
  const std::optional<double> own = method_->elasticEnergy();
  out_.elastic_energy = own ? *own : body_.elasticity->energy(body_.x);
  if (!own && !body_.elasticity->viscous()) body_.elastic_energy = out_.elastic_energy;
  rest_.remember(out_);
}

std::string stateKind(const FemSettings& settings, Eigen::Index num_points) {
  return "fem " + settings.method + " " + settings.integrator + " " + settings.element + " " +
         settings.contact.model + ", " + std::to_string(num_points) + " points";
}

std::unique_ptr<FemOrgan> makeFemOrgan(const mesh::TetMesh& mesh,
                                       const fem::Composition& composition,
                                       const Surroundings& surroundings,
                                       const FemSettings& settings, ThreadPool* pool,
                                       const OwnParts& own) {
  auto organ = std::make_unique<FemOrgan>(mesh, composition, surroundings, settings, pool,
                                          Eigen::Matrix3Xi(), own);
  organ->findEquilibrium();
  return organ;
}

std::unique_ptr<TissueModel> makeFemTissue(const mesh::TetMesh& mesh,
                                           const fem::Composition& composition,
                                           const Surroundings& surroundings,
                                           const FemSettings& settings, ThreadPool* pool) {
  return makeFemOrgan(mesh, composition, surroundings, settings, pool);
}

}  // namespace palpate::tissue
