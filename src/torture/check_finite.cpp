// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "checks.h"

namespace palpate::torture {
namespace {

class Finite : public Criterion {
 public:
  std::string check(const Cycle& cycle) override {
    for (int i = 0; i < cycle.simulator.numOrgans(); ++i) {
      const tissue::SurfaceState shape = cycle.simulator.surfaceState(i);
      if (!shape.positions.allFinite()) return "positions";
      if (!shape.velocities.allFinite()) return "velocities";
    }
    for (const sim::InstrumentResult& tool : cycle.result.instruments) {
      if (!tool.spatial.allFinite() || !tool.solved.allFinite()) return "wrench";
    }
    for (const sim::ContactPoint& point : cycle.result.contacts) {
      if (!point.p_W.allFinite() || !point.force_W.allFinite()) return "contact";
    }
    for (const auto& figure : sim::reportFigures()) {
      const auto* real = std::get_if<double sim::StepReport::*>(&figure.value);
      if (real && !std::isfinite(cycle.result.report.**real)) return figure.name;
    }
    const bool failed = cycle.result.report.status == solver::SolveStatus::kNonFinite;
    return failed ? "status non_finite" : "";
  }
};

}  // namespace

std::unique_ptr<Criterion> checkFinite() { return std::make_unique<Finite>(); }

}  // namespace palpate::torture
