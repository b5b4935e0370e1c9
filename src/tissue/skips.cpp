// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/skips.h"

namespace palpate::tissue {

const std::vector<Skip>& skips() {
  using Step = TissueStep;
  using On = SkipSwitches;
  using Of = SkipCounters;
  static const std::vector<Skip> kAll = {
      {"far_tools", &On::far_tools,
       "Contact of tool shapes and anatomy that cannot touch in the cycle.", "far_bodies",
       &Of::far_bodies, &Step::far_bodies, true},
      {"sleeping", &On::sleeping, "Solves of organs that are at rest and untouched.",
       "sleeping_organs", &Of::sleeping_organs, &Step::slept, true},
      {"islands", &On::islands,
       "Solves of parts at rest of an organ that consists of unconnected parts.",
       "sleeping_islands", &Of::sleeping_islands, &Step::sleeping_islands, true},
      {nullptr, nullptr, "Newton iterations where the predictor is within tolerance.",
       "satisfied_solves", &Of::satisfied_solves, &Step::satisfied, true},
      {"distant_samples", &On::distant_samples,
       "Contact of surface points that no tool can reach in the cycle.", "distant_samples",
       &Of::distant_samples, &Step::distant_samples, false},
      {"inactive_samples", &On::inactive_samples,
       "Derivatives of the contact of surface points that do not touch.", "inactive_samples",
       &Of::inactive_samples, &Step::inactive_samples, false},
      {nullptr, nullptr, "Friction of touches where it cannot act.", "frictionless_touches",
       &Of::frictionless_touches, &Step::frictionless_touches, false},
      {"viscous_terms", &On::viscous_terms, "Viscous memory of solids that are not viscous.",
       "inviscid_solids", &Of::inviscid_solids, &Step::inviscid_solids, false},
      {"unchanged_stiffness", &On::unchanged_stiffness,
       "Assembly of the elastic stiffness where the organ has hardly changed its shape since the "
       "last one; methods `implicit_pcg`, `implicit_direct` and `implicit_async`.",
       "kept_stiffnesses", &Of::kept_stiffnesses, &Step::kept_stiffnesses, true},
      {nullptr, nullptr, "Points outside of the region that moves (`organs[].springs.region`).",
       "still_points", &Of::still_points, &Step::still_points, false},
      {"apart_organs", &On::apart_organs,
       "Solving together, and the search for contact, of bodies that cannot act on each other in "
       "the cycle; pairs.",
       "apart_organs", &Of::apart_organs, &Step::apart_organs, true},
  };
  return kAll;
}

int Skip::of(const TissueStep& step) const {
  return std::visit([&](auto member) { return static_cast<int>(step.*member); }, figure);
}

void mergeSkips(Over over, const TissueStep& part, TissueStep* whole) {
  for (const Skip& skip : skips()) {
    if (const auto* number = std::get_if<int TissueStep::*>(&skip.figure)) {
      whole->** number += part.**number;
    } else {
      const auto holds = std::get<bool TissueStep::*>(skip.figure);
      whole->*holds = whole->*holds && (part.*holds || part.slept);
    }
  }
  if (over == Over::kParts) whole->sleeping_islands += part.slept;
}

std::int64_t SkipCounters::total() const {
  std::int64_t sum = 0;
  for (const Skip& skip : skips()) {
    if (skip.in_total) sum += this->*skip.count;
  }
  return sum;
}

SkipCounters& SkipCounters::operator+=(const SkipCounters& other) {
  for (const Skip& skip : skips()) {
    if (skip.count) this->*skip.count += other.*skip.count;
  }
  return *this;
}

}  // namespace palpate::tissue
