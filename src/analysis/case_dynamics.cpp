// SPDX-License-Identifier: GPL-3.0-or-later
#include "case_dynamics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "palpate/base/error.h"

namespace palpate::analysis {
namespace {

// An analysis is not in real time.
constexpr int kMaxTimeSteps = 64;

tissue::FemSettings settingsOf(const Case& problem, const DynamicAnalysis& analysis) {
  tissue::FemSettings settings;
  settings.element = problem.element;
  settings.method = analysis.method;
  settings.integrator = analysis.integrator;
  settings.step = analysis.dt;
  settings.mass_damping = analysis.damping.mass;
  settings.stiffness_damping = analysis.damping.stiffness;
  settings.tolerance = analysis.tolerance;
  settings.position_tolerance = 0.0;  // only the force tolerance counts
  settings.max_newton_iterations = analysis.max_newton_iterations;
  settings.linear_tolerance = analysis.linear_tolerance;
  settings.max_linear_iterations = analysis.max_linear_iterations;
  settings.max_time_steps = kMaxTimeSteps;
  settings.only_converged = true;
  return settings;
}

int rejected(int time_steps) { return static_cast<int>(std::lround(std::log2(time_steps))); }

}  // namespace

CaseDynamics::CaseDynamics(const Case& problem, CaseModel* model, const CaseProbes& probes,
                           ThreadPool* pool)
    : analysis_(std::get<DynamicAnalysis>(problem.analysis)), model_(*model), probes_(probes) {
  model->setLoadFactor(1.0);
  tissue::Drive drive;
  drive.loads = model->potential().terms;
  drive.load_norm = model->loadNorm();
  drive.held = [this](double s) {
    const double ramp = analysis_.ramp_time.value_or(analysis_.duration);
    return model_.heldPositions(std::min(1.0, (time_ + s * analysis_.dt) / ramp));
  };
  try {
    body_ = std::make_unique<tissue::FemDynamics>(
        model->mesh(), model->composition(), model->potential().free,
        settingsOf(problem, analysis_), model->elasticity(), drive, pool);
  } catch (const std::invalid_argument& error) {
    throw InputError(problem.file, "analysis", "", error.what());
  }
}

solver::SolveStatus CaseDynamics::run(SolveResult* result, ProbeHistory* history,
                                      const std::function<void(double)>& progress) {
  const int steps = std::max(1, static_cast<int>(std::lround(analysis_.duration / analysis_.dt)));
  history->columns = probes_.columns();
  record(0.0, history);
  for (int k = 1; k <= steps; ++k) {
    time_ = (k - 1) * analysis_.dt;
    const bool done = body_->advance(analysis_.dt);
    const tissue::TissueStep& step = body_->report();
    result->newton_iterations += step.newton_iterations;
    result->rejected_steps += rejected(step.time_steps) + !done;
    result->residual = analysis_.tolerance * step.residual / step.tolerance;
    if (!done) return step.status;
    result->load_steps = k;
    record(k * analysis_.dt, history);
    if (progress) progress(static_cast<double>(k) / steps);
  }
  return solver::SolveStatus::kConverged;
}

void CaseDynamics::record(double t, ProbeHistory* history) const {
  history->rows.push_back(
      CaseProbes::row(t, probes_.measure(model_, body_->positions(), body_->supportForces())));
}

}  // namespace palpate::analysis
