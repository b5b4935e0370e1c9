// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "case_model.h"
#include "case_probes.h"
#include "palpate/analysis/case_solver.h"
#include "palpate/tissue/fem/fem_dynamics.h"

namespace palpate::analysis {

/// Time steps of a dynamic case, with the methods of a scene's organs.
class CaseDynamics {
 public:
  /// @throws InputError for settings that the method refuses.
  CaseDynamics(const Case& problem, CaseModel* model, const CaseProbes& probes, ThreadPool* pool);

  /// Runs all steps, from rest.
  solver::SolveStatus run(SolveResult* result, ProbeHistory* history,
                          const std::function<void(double)>& progress);
  const tissue::FemDynamics& body() const { return *body_; }

 private:
  void record(double t, ProbeHistory* history) const;

  const DynamicAnalysis& analysis_;
  CaseModel& model_;
  const CaseProbes& probes_;
  std::unique_ptr<tissue::FemDynamics> body_;
  double time_ = 0.0;  // begin of the present step [s]
};

}  // namespace palpate::analysis
