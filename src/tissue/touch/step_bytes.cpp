// SPDX-License-Identifier: GPL-3.0-or-later
#include "step_bytes.h"

namespace palpate::tissue {
namespace {

// Calls visit(value) for all figures except those that depend on machine speed.
template <class Step, class Visit>
void forNumbers(Step& step, const Visit& visit) {
  for (const Figure<StepFigures>& figure : stepFigures()) {
    std::visit(
        [&](auto member) {
          if constexpr (std::is_same_v<decltype(member), int StepFigures::*>) {
            if (member == &StepFigures::factor_waits) return;
          }
          visit(step.*member);
        },
        figure.value);
  }
  visit(step.support_force), visit(step.gravity_force), visit(step.inertia_force);
  visit(step.interaction_force);
  visit(step.far_bodies), visit(step.slept), visit(step.satisfied), visit(step.sleeping_islands);
  visit(step.distant_samples), visit(step.inactive_samples), visit(step.inviscid_solids);
  visit(step.frictionless_touches), visit(step.kept_stiffnesses), visit(step.apart_organs);
  visit(step.still_points);
}

// A new member of TissueStep must be named here to compile.
template <class Contact, class Visit>
void forNumbersOfContact(Contact& contact, const Visit& visit) {
  auto& [owner, penetration, p_W, force_W, organ] = contact;
  visit(owner.index), visit(owner.fixed), visit(penetration), visit(p_W), visit(force_W),
      visit(organ);
}

}  // namespace

void putStep(const TissueStep& step, StateWriter* out) {
  forNumbers(step, [&](const auto& value) { out->put(value); });
  out->put(static_cast<std::int64_t>(step.contacts.size()));
  for (const TissueContact& contact : step.contacts) {
    forNumbersOfContact(contact, [&](const auto& value) { out->put(value); });
  }
}

void getStep(StateReader* in, TissueStep* step) {
  step->clear();
  forNumbers(*step, [&](auto& value) { in->get(&value); });
  const std::int64_t contacts = in->count(static_cast<std::int64_t>(2 * sizeof(Vec3)));
  for (std::int64_t k = 0; k < contacts; ++k) {
    TissueContact contact{};
    forNumbersOfContact(contact, [&](auto& value) { in->get(&value); });
    step->contacts.push_back(contact);
  }
}

}  // namespace palpate::tissue
