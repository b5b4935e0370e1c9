// SPDX-License-Identifier: GPL-3.0-or-later
#include "step_bytes.h"

namespace palpate::tissue {
namespace {

// visit(value) on all numbers of a step but those that depend on time. A figure that is new and not
// named here does not compile.
template <class Step, class Visit>
void forNumbers(Step& step, const Visit& visit) {
  auto& [status, contacts, support_force, gravity_force, inertia_force, sweep_stages, time_steps,
         newton_iterations, linear_iterations, factor_waits, residual, tolerance, min_jacobian,
         kinetic_energy, elastic_energy, far_bodies, slept, satisfied, sleeping_islands,
         distant_samples, inactive_samples, inviscid_solids, kept_stiffnesses, phases] = step;
  (void)contacts, (void)factor_waits, (void)phases;
  const auto all = [&](auto&... values) { (visit(values), ...); };
  all(status, support_force, gravity_force, inertia_force, sweep_stages, time_steps,
      newton_iterations, linear_iterations, residual, tolerance, min_jacobian, kinetic_energy,
      elastic_energy, far_bodies, slept, satisfied, sleeping_islands, distant_samples,
      inactive_samples, inviscid_solids, kept_stiffnesses);
}

template <class Contact, class Visit>
void forNumbersOfContact(Contact& contact, const Visit& visit) {
  auto& [instrument, penetration, p_W, force_W, organ] = contact;
  visit(instrument), visit(penetration), visit(p_W), visit(force_W), visit(organ);
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
