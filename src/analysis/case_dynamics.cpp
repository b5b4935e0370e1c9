// SPDX-License-Identifier: GPL-3.0-or-later
#include "case_dynamics.h"

#include <algorithm>
#include <cmath>

#include "palpate/solver/minimizer_list.h"

namespace palpate::analysis {
namespace {

constexpr int kMaxLinearIterations = 5000;
constexpr int kMaxCuts = 6;  // halvings of a step that fails

}  // namespace

CaseDynamics::CaseDynamics(const DynamicAnalysis& analysis, CaseModel* model,
                           const CaseProbes& probes)
    : analysis_(analysis),
      model_(*model),
      probes_(probes),
      integrator_(analysis.integrator, model->elasticity().masses(),
                  {analysis.damping.mass, analysis.damping.stiffness}),
      potential_(model->potential()),
      minimizer_(solver::makeMinimizer(analysis.method, {kMaxLinearIterations},
                                       model->elasticity().makeMatrix())) {
  integrator_.addTerms(&potential_);
  model->setLoadFactor(1.0);
  load_norm_ = model->loadNorm();
  const double area = std::pow(
      model->elasticity().volume() / static_cast<double>(model->mesh().numPoints()), 2.0 / 3.0);
  force_floor_ = 0.01 * model->composition().softestShearModulus() * area;
}

solver::SolveStatus CaseDynamics::run(Points* x, SolveResult* result, ProbeHistory* history,
                                      const std::function<void(double)>& progress) {
  const int steps = std::max(1, static_cast<int>(std::lround(analysis_.duration / analysis_.dt)));
  history->columns = probes_.columns();
  integrator_.start(*x, Points::Zero(3, x->cols()));
  model_.elasticity().relax(*x);
  integrator_.beginStep(analysis_.dt, &potential_);
  history->rows.push_back(
      CaseProbes::row(0.0, probes_.measure(model_, *x, Points::Zero(3, x->cols()))));
  for (int k = 1; k <= steps; ++k) {
    minimizer_->beginCycle(analysis_.dt);
    const solver::SolveStatus status = advance((k - 1) * analysis_.dt, analysis_.dt, x, result);
    if (status != solver::SolveStatus::kConverged) return status;
    result->load_steps = k;
    record(k * analysis_.dt, *x, history);
    if (progress) progress(static_cast<double>(k) / steps);
  }
  return solver::SolveStatus::kConverged;
}

// From t to t + h, in 1, 2, 4 ... steps: the first number that works.
solver::SolveStatus CaseDynamics::advance(double t, double h, Points* x, SolveResult* result) {
  const solver::Integrator begin = integrator_;
  const std::unique_ptr<fem::ViscousState> viscous = model_.elasticity().saveViscousState();
  solver::SolveStatus status = solver::SolveStatus::kConverged;
  for (int cut = 0, parts = 1; cut <= kMaxCuts; ++cut, parts *= 2) {
    Points trial = *x;
    status = solver::SolveStatus::kConverged;
    for (int k = 0; k < parts && status == solver::SolveStatus::kConverged; ++k) {
      status = tryStep(t + (k + 1) * h / parts, h / parts, &trial, result);
    }
    if (status == solver::SolveStatus::kConverged) {
      *x = trial;
      return status;
    }
    ++result->rejected_steps;
    integrator_ = begin;
    model_.elasticity().restoreViscousState(viscous.get());
  }
  return status;
}

// One step of `h` that ends at time `t`.
solver::SolveStatus CaseDynamics::tryStep(double t, double h, Points* x, SolveResult* result) {
  integrator_.beginStep(h, &potential_);
  model_.elasticity().beginStep(h);
  const double ramp = analysis_.ramp_time.value_or(analysis_.duration);
  const Points move = (model_.heldPositions(std::min(1.0, t / ramp)) - *x).array() *
                      (1.0 - potential_.free.array());
  if (!move.isZero(0.0)) {
    const solver::SolveStatus moved = minimizer_->predict(potential_, move, x);
    if (moved != solver::SolveStatus::kConverged) return moved;
  }
  solver::NewtonSettings settings;
  const double scale = std::max({load_norm_, last_reaction_, force_floor_});
  settings.tolerance = std::max(analysis_.tolerance * scale, minimizer_->roundoffForce(*x));
  settings.max_iterations = analysis_.max_newton_iterations;
  settings.linear_tolerance = analysis_.linear_tolerance;
  const solver::NewtonReport solved = minimizer_->minimize(potential_, settings, x);
  result->newton_iterations += solved.iterations;
  result->residual = solved.residual / scale;
  if (solved.status != solver::SolveStatus::kConverged) return solved.status;
  last_reaction_ = supportForce(*x).norm();
  Points elastic;
  if (integrator_.needsElasticGradient()) model_.elasticity().gradient(*x, &elastic);
  integrator_.endStep(*x, elastic);
  model_.elasticity().endStep(*x);
  return solved.status;
}

// Before the next step begins, the potential still is that of the last one.
Points CaseDynamics::supportForce(const Points& x) const {
  Points g;
  potential_.gradient(x, &g);
  return g.array() * (1.0 - potential_.free.array());
}

void CaseDynamics::record(double t, const Points& x, ProbeHistory* history) const {
  history->rows.push_back(CaseProbes::row(t, probes_.measure(model_, x, supportForce(x))));
}

}  // namespace palpate::analysis
