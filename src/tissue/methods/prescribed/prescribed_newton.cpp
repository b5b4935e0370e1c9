// SPDX-License-Identifier: GPL-3.0-or-later
#include "prescribed_newton.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "interruptible_matrix.h"
#include "palpate/solver/cholmod_solver.h"
#include "sparse_assembly.h"

namespace palpate::tissue {
namespace {

constexpr int kMaxParts = 8;
constexpr int kMaxStepHalvings = 10;
// Most changes of holds in a stage.
constexpr int kMaxChanges = 30;
// Largest change of energy over the tangent's prediction [-]; beyond it exponential laws diverge.
constexpr double kTrustsTangent = 100.0;
constexpr double kOfEnergy = 1e-6;  // relative increase within roundoff [-]
constexpr double kNoPush = 1e-6;    // stiffness that counts as zero, over the mean [-]
// Distance of a held point from the tool that counts as zero, over the body's size [-].
constexpr double kOnSurface = 1e-9;

}  // namespace

PrescribedNewton::PrescribedNewton(FemBody* body)
    : body_(*body),
      contact_(makePrescribedDisplacements(body)),
      stiffness_(body->elasticity->makeMatrix()) {
  assembleSparse(stiffness_);  // throws for unsupported elements
}

void PrescribedNewton::restart() {
  contact_->clear();
  residual_ = gradient();
}

void PrescribedNewton::save(StateWriter* out) const {
  contact_->save(out);
  out->put(residual_);
}

void PrescribedNewton::restore(StateReader* in) {
  contact_->restore(in);
  in->get(&residual_);
}

// Computes g at x. Returns its norm over free components [N].
double PrescribedNewton::gradient() {
  value_ = body_.elasticity->gradient(body_.x, &g_);
  value_ += body_.addLoads(body_.x, &g_);
  const double norm = contact_->unbalanced(g_);
  return std::isfinite(value_) ? norm : value_;
}

double PrescribedNewton::energy(const Points& x) {
  unused_.setZero(3, x.cols());
  return body_.elasticity->energy(x) + body_.addLoads(x, &unused_);
}

bool PrescribedNewton::advance(double dt, TissueStep* out) {
  x_begin_ = body_.x;
  const bool held = contact_->holds();
  out->tolerance = body_.tolerance();
  contact_->keep();
  const std::unique_ptr<fem::ViscousState> viscous = body_.elasticity->saveViscousState();
  if (body_.elasticity->viscous()) body_.elasticity->beginStep(dt);
  for (int parts = 1; parts <= kMaxParts; parts *= 2) {
    out->time_steps = parts;
    if (sweep(parts, out) && isPlausible(held, *out)) {
      if (body_.elasticity->viscous()) body_.elasticity->endStep(body_.x);
      body_.v = (body_.x - x_begin_) / dt;
      out->residual = residual_;
      out->satisfied = out->newton_iterations == 0 && out->ok();
      contact_->addWork(out);
      return true;
    }
    body_.x = x_begin_;
    contact_->goBack();
    if (solver::isInterrupted(body_.interrupt)) break;
  }
  body_.elasticity->restoreViscousState(viscous.get());
  contact_->addWork(out);
  const bool late = out->status == solver::SolveStatus::kDeadline;
  if (!late && solver::usable(out->status)) {
    out->status = solver::SolveStatus::kNotPositiveDefinite;
  }
  return false;
}

// Checks the result of Newton's method, which may find an unstable root, forces near zero far away,
// or inverted elements after a deadline.
bool PrescribedNewton::isPlausible(bool held, const TissueStep& out) {
  if (!(contact_->nodalNorm(g_) <= FemBody::kMostForce)) return false;
  const bool holds = held || contact_->holds();
  if (holds && out.status == solver::SolveStatus::kDeadline) {
    const double least = body_.elasticity->minJacobian(body_.x);
    if (!(least > 0.0 || least >= body_.elasticity->minJacobian(x_begin_))) return false;
  }
  if (holds || body_.heldMoves() || body_.surroundings.moves()) return true;
  const double unbalanced = out.ok() ? residual_ * (body_.x - x_begin_).norm() : 0.0;
  return value_ - *value_begin_ <= unbalanced + kOfEnergy * std::abs(*value_begin_);
}

bool PrescribedNewton::restsInMinimum() {
  TissueStep unused;
  contact_->moves(body_.x, &move_);
  assemble(&unused);
  std::vector<Mat3> blocks;
  stiffness_.diagonal(&blocks);
  double trace = 0.0;
  for (const Mat3& block : blocks) trace += block.trace();
  // Rigid modes have zero stiffness up to rounding.
  const auto n = static_cast<double>(blocks.size());
  for (int i = 0; i < body_.x.cols(); ++i) stiffness_.addToDiagonal(i, kNoPush * trace / n);
  solver::CholmodSolver solver;
  const solver::LinearReport solved = solver.solve(stiffness_, g_, 1e-3, &trial_);
  return solved.status != solver::SolveStatus::kNotPositiveDefinite;
}

// Moves the tools along their path in at least `parts` stages.
bool PrescribedNewton::sweep(int parts, TissueStep* out) {
  value_begin_.reset();
  out->sweep_stages = 0;
  body_.tool_path.moveTo(0.0);
  for (double s = 0.0; s < 1.0;) {
    const double begin = s;
    s = contact_->nextStage(body_.x, begin, std::min(1.0, begin + 1.0 / parts));
    if (s > 1.0 - 1e-9) s = 1.0;
    ++out->sweep_stages;
    body_.tool_path.moveTo(s);
    part_ = s;
    body_.surroundings.moveTo(s);
    solveStage(begin, out);
    if (!solver::usable(out->status) || !body_.x.allFinite()) return false;
    if (out->status == solver::SolveStatus::kDeadline) return true;
  }
  return true;
}

// Newton's method with an active set of held points.
void PrescribedNewton::solveStage(double begin, TissueStep* out) {
  {
    const PhaseTimer timer(&out->phases, Phase::kContact);
    contact_->beginStage(body_.x, begin, part_);
    contact_->holdWhatPenetrates(body_.x);
  }
  for (int change = 0;; ++change) {
    newton(out);
    const PhaseTimer timer(&out->phases, Phase::kContact);
    if (!out->ok()) {
      // Tissue in tension would not converge and would follow the tool.
      const bool gave_up = out->status == solver::SolveStatus::kIterationLimit;
      if (gave_up && contact_->release(body_.x, g_)) residual_ = gradient();
      return;
    }
    if (!body_.tool_path.candidatesHold(body_.x)) body_.tool_path.search(body_.x);
    const bool released = contact_->release(body_.x, g_);
    const bool held = !released && contact_->holdWhatPenetrates(body_.x);
    if (!released && !held) return;
    if (change == kMaxChanges) {
      out->status = solver::SolveStatus::kIterationLimit;
      residual_ = gradient();
      return;
    }
  }
}

void PrescribedNewton::newton(TissueStep* out) {
  bool to_rest = false;  // the last step moved no held point
  for (int k = 0;; ++k) {
    const double before = value_;
    {
      const PhaseTimer timer(&out->phases, Phase::kForces);
      residual_ = gradient();
      if (!value_begin_) value_begin_ = value_;
      if (k > 0 && !std::isfinite(residual_)) shorten(std::numeric_limits<double>::max());
      contact_->moves(body_.x, &move_);
      if (body_.heldWay(part_, &held_way_)) move_ += held_way_;
    }
    if (!std::isfinite(residual_)) {
      out->status = solver::SolveStatus::kNonFinite;
      return;
    }
    out->status = solver::SolveStatus::kConverged;
    const bool on_surface = move_.cwiseAbs().maxCoeff() <= kOnSurface * body_.size;
    if (residual_ <= out->tolerance && on_surface) return;
    out->status = solver::SolveStatus::kIterationLimit;
    if (k == body_.settings.max_newton_iterations) return;
    if (k > 0 && solver::isInterrupted(body_.interrupt)) {
      if (to_rest && !shorten(before)) descend(before);
      out->status = solver::SolveStatus::kDeadline;
      return;
    }
    to_rest = on_surface;
    if (!iterate(out)) return;
    ++out->newton_iterations;
  }
}

// Halves a step to non-finite forces, or the last one, until the energy is at most `most` [J].
// Returns false, without the step, where none is. Other steps are not globalised.
bool PrescribedNewton::shorten(double most) {
  const auto good = [&] { return std::isfinite(residual_) && value_ < most; };
  for (int k = 0; k < kMaxStepHalvings && !good(); ++k) {
    step_ *= 0.5;
    body_.x = trial_ + step_;
    residual_ = gradient();
  }
  if (good()) return true;
  body_.x = trial_;
  residual_ = gradient();
  return false;
}

// At a deadline, a descent step by forces and the tangent's diagonal where Newton's step ascends.
void PrescribedNewton::descend(double most) {
  const Eigen::Map<const Eigen::VectorXd> b(right_.data(), right_.size());
  const Eigen::VectorXd way = b.cwiseQuotient(diagonal_);
  if (!way.allFinite()) return;
  step_ = Eigen::Map<const Points>(way.data(), 3, right_.cols()).cwiseProduct(contact_->free());
  contact_->expand(&step_);
  trial_ = body_.x;
  body_.x += step_;
  residual_ = gradient();
  shorten(most);
}

// x += move - K^-1 (g + K move); the second part on free components, shortened where the energy
// deviates from the tangent.
bool PrescribedNewton::iterate(TissueStep* out) {
  const Eigen::SparseMatrix<double> A = assemble(out);
  if (!solve(A, out)) {
    out->status = solver::SolveStatus::kNotPositiveDefinite;
    return false;
  }
  const PhaseTimer timer(&out->phases, Phase::kLineSearch);
  double slope = std::abs(g_.cwiseProduct(step_).sum());
  double curved = 0.5 * std::abs(curvature_);
  for (int k = 0; k <= kMaxStepHalvings; ++k, step_ *= 0.5, slope *= 0.5, curved *= 0.25) {
    trial_ = body_.x + step_;
    const double most = value_ + kTrustsTangent * (slope + curved) + kOfEnergy * std::abs(value_);
    if (!(energy(trial_) <= most)) continue;  // NaN too
    body_.x.swap(trial_);
    return true;
  }
  out->status = solver::SolveStatus::kLineSearchFailed;
  return false;
}

// Assembles K and the right side at x, without held components.
Eigen::SparseMatrix<double> PrescribedNewton::assemble(TissueStep* out) {
  const PhaseTimer timer(&out->phases, Phase::kAssembly);
  body_.elasticity->hessian(body_.x, fem::Tangent::kExact, &stiffness_);
  stiffness_.forgetAdded();
  for (const fem::EnergyTerm* term : body_.surroundings.terms()) {
    term->addHessian(body_.x, fem::Tangent::kExact, &stiffness_);
  }
  stiffness_.multiply(move_, &stiff_move_);
  right_ = -(g_ + stiff_move_).cwiseProduct(contact_->free());
  contact_->reduce(&right_);
  stiffness_.constrain(contact_->free());
  Eigen::SparseMatrix<double> A = assembleSparse(stiffness_);
  contact_->reduce(&A);
  return A;
}

// Solves for the step, with moves. Returns false where it is not finite. After an interrupt the
// step is the solver's iterate.
bool PrescribedNewton::solve(const Eigen::SparseMatrix<double>& A, TissueStep* out) {
  const PhaseTimer timer(&out->phases, Phase::kLinearSolve);
  Eigen::BiCGSTAB<InterruptibleMatrix, InterruptibleMatrix::Diagonal> solver;
  solver.setTolerance(body_.settings.linear_tolerance);
  solver.setMaxIterations(body_.settings.max_linear_iterations);
  const InterruptibleMatrix matrix(A, body_.interrupt);
  solver.compute(matrix);
  diagonal_ = A.diagonal().cwiseAbs();
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(A.rows());
  try {
    solution = solver.solve(Eigen::Map<const Eigen::VectorXd>(right_.data(), right_.size()));
    out->linear_iterations += static_cast<int>(solver.iterations());
  } catch (const InterruptibleMatrix::Interrupted&) {
    out->linear_iterations += matrix.products() / 2 - 1;
    // Scaled to the minimum along it, since an iterate may ascend.
    const Eigen::Map<const Eigen::VectorXd> b(right_.data(), right_.size());
    const double down = b.dot(solution), curved = solution.dot(A * solution);
    solution = down > 0.0 && curved > 0.0 ? Eigen::VectorXd(down / curved * solution)
                                          : Eigen::VectorXd::Zero(A.rows());
  }
  step_ =
      Eigen::Map<const Points>(solution.data(), 3, right_.cols()).cwiseProduct(contact_->free());
  curvature_ = step_.cwiseProduct(right_).sum();
  contact_->expand(&step_);
  curvature_ += (2.0 * step_ + move_).cwiseProduct(stiff_move_).sum();
  step_ += move_;
  return step_.allFinite();
}

void PrescribedNewton::reportForces(TissueStep* out) {
  const PhaseTimer timer(&out->phases, Phase::kForces);
  body_.reportSupport(g_, out);
  contact_->report(body_.x, g_, out);
  body_.contact_force = contact_->nodalNorm(g_);
}

}  // namespace palpate::tissue
