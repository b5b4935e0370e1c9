// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/sim/step_report.h"

#include <utility>

namespace palpate::sim {

using tissue::Figure;
using tissue::Merge;

const std::vector<Figure<StepReport>>& reportFigures() {
  static const std::vector<Figure<StepReport>> kAll = [] {
    using R = StepReport;
    using M = Merge;
    std::vector<Figure<R>> all = {
        {"time", "float64", "simulated time at the end of the cycle [s]", &R::time, M::kLast,
         M::kLast, M::kLast},
        {"step", "float64", "simulated length of the cycle [s]", &R::step, M::kLast, M::kLast,
         M::kLast},
        {"contacts", "int32", "active contact samples, all instruments", &R::contacts, M::kSum,
         M::kSum, M::kLast},
        {"max_penetration", "float64", "deepest sample inside a tool [m]", &R::max_penetration,
         M::kLargest, M::kLargest, M::kLargest},
        {"imbalance", "float64", "|tool + support + gravity + inertia forces| [N]", &R::imbalance,
         M::kSum, M::kSum, M::kLargest},
        {"nodes", nullptr, "of all organs' meshes, as they are now", &R::nodes, M::kSum, M::kSum,
         M::kLast},
        {"mesh_changes", nullptr, "how often the mesh of an organ became another", &R::mesh_changes,
         M::kSum, M::kSum, M::kSum},
        {"state_hash", "uint64",
         "of positions, velocities and wrenches: the same where two runs are", &R::state_hash,
         M::kLast, M::kLast, M::kLast},
    };
    for (const Figure<tissue::StepFigures>& f : tissue::stepFigures()) {
      all.push_back(
          {f.name, f.message, f.doc,
           std::visit([](auto member) -> decltype(Figure<R>::value) { return member; }, f.value),
           f.over_parts, f.over_organs, f.over_sub_steps});
    }
    return all;
  }();
  return kAll;
}

void addSubSteps(const StepReport& earlier, StepReport* report) {
  StepReport all = earlier;
  tissue::mergeFigures(reportFigures(), tissue::Over::kSubSteps, *report, &all);
  all.skipped += report->skipped;
  all.phases += report->phases;
  *report = all;
}

}  // namespace palpate::sim
