// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "checks.h"
#include "recomputed_residual.h"

namespace palpate::torture {
namespace {

// A reported wrench must be the sum of the reported contact forces, also with bone.
std::string wrongWrench(const sim::StepResult& result) {
  for (std::size_t i = 0; i < result.instruments.size(); ++i) {
    const sim::InstrumentResult& tool = result.instruments[i];
    if (!tool.live) continue;
    Wrench sum;
    double parts = 0.0;
    for (const sim::ContactPoint& point : result.contacts) {
      if (point.instrument != static_cast<int>(i)) continue;
      const Vec3 arm = point.p_W - tool.X_WC.translation();
      sum += Wrench{point.force_W, arm.cross(point.force_W)};
      parts += point.force_W.norm() * (1.0 + arm.norm());
    }
    const double off =
        std::max((sum.force - tool.solved.force).norm(), (sum.torque - tool.solved.torque).norm());
    if (off > kRoundingOfForces * parts + 1e-12)
      return said("wrench is off the sum of contacts by", off, "N");
  }
  return "";
}

// In a converged cycle all forces sum to at most the residual times the square root of the number
// of nodes.
std::string wrongSum(const Cycle& cycle, bool friction) {
  const sim::StepReport& report = cycle.result.report;
  double forces = 0.0;
  for (const sim::ContactPoint& point : cycle.result.contacts) forces += point.force_W.norm();
  const double left = std::max(report.residual, report.tolerance);
  const double bound = kTwice * std::sqrt(static_cast<double>(report.nodes)) * left;
  const double part = friction ? kOfFriction : kRoundingOfForces;
  if (report.imbalance <= bound + part * forces + 1e-12) return "";
  return said("forces add up to", report.imbalance, "N,") + said(" told", left, "N at the points") +
         " after " + std::to_string(report.sweep_stages) + " stages";
}

class Truth : public Criterion {
 public:
  Truth(const TortureScene& scene, const sim::Simulator& simulator)
      : scene_(scene), residual_(scene, simulator) {}

  std::string check(const Cycle& cycle) override {
    const sim::StepReport& report = cycle.result.report;
    std::string wrong = wrongWrench(cycle.result);
    if (wrong.empty() && report.ok() && report.residual > report.tolerance) {
      wrong =
          said("converged with a residual of", report.residual / report.tolerance, "tolerances");
    }
    if (wrong.empty() && report.ok()) wrong = wrongSum(cycle, scene_.friction > 0.0);
    if (wrong.empty()) wrong = residual_.check(cycle);
    residual_.remember(cycle.simulator);
    return wrong;
  }

  void placed(const sim::Simulator& simulator) override { residual_.remember(simulator); }

 private:
  const TortureScene& scene_;
  RecomputedResidual residual_;
};

}  // namespace

std::unique_ptr<Criterion> checkTruth(const TortureScene& scene, const sim::Simulator& simulator) {
  return std::make_unique<Truth>(scene, simulator);
}

}  // namespace palpate::torture
