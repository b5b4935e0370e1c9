// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/contact/contact_potential.h"
#include "sample_runs.h"

namespace palpate::contact {

// visit(candidate) of those that are not in a run that is far(run, its least gap); of all where
// samples that do not touch are not to be skipped.
template <class Far, class Visit>
void ContactPotential::forCandidates(const Points& x, const Far& far, const Visit& visit) const {
  if (!skip_inactive_) {
    for (const SampleCandidate& c : candidates_) visit(c);
    return;
  }
  runs_->forEach(x, posed_, far, [&](int k) { visit(candidates_[static_cast<std::size_t>(k)]); });
}

}  // namespace palpate::contact
