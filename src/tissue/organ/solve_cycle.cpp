// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <optional>

#include "fem_organ.h"

namespace palpate::tissue {
namespace {

using Members = std::vector<FemOrgan*>;

template <class Test>
bool all(const Members& members, const Test& test) {
  return std::all_of(members.begin(), members.end(), test);
}

bool isTouched(const Members& members) {
  return std::any_of(members.begin(), members.end(),
                     [](const FemOrgan* member) { return member->isTouched(); });
}

// Returns a member whose backoff skips the cycle, and so all; null without one, or where another
// member is due for a retry. Asks every member, since each counts its cycles.
const FemOrgan* frozenMember(const Members& members) {
  const FemOrgan* frozen = nullptr;
  bool due = false;
  for (FemOrgan* member : members) {
    const bool failing = member->isFailing();
    if (member->isFrozen()) {
      frozen = member;
    } else {
      due = due || failing;
    }
  }
  return due ? nullptr : frozen;
}

// Whether the members rest: no displacement, and static forces within tolerance, also by the
// present forces, since a tool may have left.
bool cameToRest(const Members& members, CycleSolver* solver, const TissueStep& solved) {
  if (!all(members, [&](const FemOrgan* m) { return m->isStill(solved); })) return false;
  if (solver->unbalancedForce() > solved.tolerance) return false;
  for (std::size_t k = 0; k < members.size(); ++k) {
    TissueStep now;
    solver->reportForcesOn(k, &now);
  }
  const double unbalanced = solver->unbalancedForce();
  return all(members, [&](const FemOrgan* m) { return unbalanced <= m->body().tolerance(); });
}

// Returns the reason to reset all members, which is one of a single member: another may occupy its
// space.
std::optional<solver::SolveStatus> reasonToReset(const Members& members, CycleSolver* solver,
                                                 const TissueStep& solved, bool at_rest) {
  bool inverted = false;
  if (!isTouched(members)) {
    for (FemOrgan* member : members) inverted |= member->shouldReset(solved, at_rest);
  }
  if (inverted) return solver::SolveStatus::kInverted;
  if (at_rest && !solver->restsInMinimum()) return solver::SolveStatus::kNotPositiveDefinite;
  return {};
}

}  // namespace

void solveCycle(const Members& members, CycleSolver* solver, double dt, TissueStep* out) {
  if (all(members, [](const FemOrgan* member) { return member->sleeps(); })) {
    for (FemOrgan* member : members) member->sleepOn();
    return;
  }
  if (isTouched(members)) {
    for (FemOrgan* member : members) member->reached();
  }
  if (const FemOrgan* failing = frozenMember(members)) {
    for (FemOrgan* member : members) member->stayFrozen(failing->failure());
    return;
  }
  for (FemOrgan* member : members) member->beginSolve();
  if (!solver->advance(dt, out)) {
    const bool for_good =
        all(members, [&](const FemOrgan* m) { return m->failsForGood(out->status); });
    for (FemOrgan* member : members) member->endFailed(*out, for_good);
    return;
  }
  const bool at_rest = cameToRest(members, solver, *out);
  const std::optional<solver::SolveStatus> why = reasonToReset(members, solver, *out, at_rest);
  for (std::size_t k = 0; k < members.size(); ++k) {
    if (why) {
      members[k]->endReset(*out, *why);
    } else {
      members[k]->endSolved(*out, at_rest, solver, k);
    }
  }
}

}  // namespace palpate::tissue
