// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/springs/spring_settings.h"

#include "spring_integrators.h"

namespace palpate::tissue {

std::vector<std::string> springIntegratorNames() {
  std::vector<std::string> names{SpringSettings().integrator};
  for (const SpringIntegrator& integrator : springIntegrators())
    names.emplace_back(integrator.name);
  return names;
}

void describe(keys::FieldVisitor& v, SpringSettings& springs) {
  v.choice({"integrator", "",
            "`implicit`: as `solver` says; the others are explicit, in sub-steps. `forward_euler` "
            "and `trapezoidal_euler` need damping."},
           springs.integrator, springIntegratorNames());
  v.number({"step", "s", "Longest sub-step of an explicit one; 0: nine tenths of the stable one."},
           springs.step, keys::Range::closed(0.0, 1.0));
  v.number({"region", "m",
            "Of an explicit one: only points that were so near a touched one at rest move, until "
            "all rest; 0: all."},
           springs.region, keys::Range::closed(0.0, 10.0));
}

}  // namespace palpate::tissue
