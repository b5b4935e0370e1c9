// SPDX-License-Identifier: GPL-3.0-or-later
#include "rest.h"

#include "step_bytes.h"

namespace palpate::tissue {

bool Rest::isStill(const Points& x, const ToolContact& tool_contact, const TissueStep& out) const {
  // A cut cycle is not a result to repeat.
  if (out.status == solver::SolveStatus::kDeadline) return false;
  if (!allowed_ || tool_contact.possibleByTools()) return false;
  const double motion = way(x);
  // Iterations that return bitwise to their start repeat.
  return motion == 0.0 || (out.newton_iterations == 0 && motion <= motion_);
}

void Rest::report(TissueStep* out) const {
  const int far = out->far_bodies;
  const int distant = out->distant_samples;
  const PhaseTimes phases = out->phases;
  *out = last_;
  out->far_bodies = far;
  out->distant_samples = distant;
  out->still_points = out->inactive_samples = out->frictionless_touches = out->inviscid_solids =
      out->kept_stiffnesses = 0;
  out->phases = phases;
  out->slept = true;
  out->satisfied = false;
  out->newton_iterations = out->linear_iterations = out->factor_waits = 0;
  out->walk_steps = out->tree_queries = 0;
  out->recovery = 0;
  out->inertia_force.setZero();
  out->sweep_stages = 1;
}

void Rest::save(StateWriter* out) const {
  out->put(asleep_);
  if (asleep_) putStep(last_, out);
}

void Rest::restore(StateReader* in) {
  in->get(&asleep_);
  if (asleep_) getStep(in, &last_);
}

}  // namespace palpate::tissue
