// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>

#include "case_model.h"
#include "case_probes.h"
#include "palpate/analysis/case_solver.h"
#include "palpate/solver/integrator.h"
#include "palpate/solver/minimizer.h"

namespace palpate::analysis {

/// Steps of a dynamic case. One whose solve fails is rejected and taken in shorter steps.
class CaseDynamics {
 public:
  CaseDynamics(const DynamicAnalysis& analysis, CaseModel* model, const CaseProbes& probes);

  /// From rest. x, 3 x n, starts and ends as the body's shape.
  solver::SolveStatus run(Points* x, SolveResult* result, ProbeHistory* history,
                          const std::function<void(double)>& progress);
  /// What the supports exert on the nodes at x, 3 x n [N].
  Points supportForce(const Points& x) const;

 private:
  solver::SolveStatus advance(double t, double h, Points* x, SolveResult* result);
  solver::SolveStatus tryStep(double t, double h, Points* x, SolveResult* result);
  void record(double t, const Points& x, ProbeHistory* history) const;

  const DynamicAnalysis& analysis_;
  CaseModel& model_;
  const CaseProbes& probes_;
  solver::Integrator integrator_;
  solver::Potential potential_;
  std::unique_ptr<solver::Minimizer> minimizer_;
  double load_norm_ = 0.0, force_floor_ = 0.0, last_reaction_ = 0.0;  // [N]
};

}  // namespace palpate::analysis
