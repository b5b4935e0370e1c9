// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/springs/spring_settings.h"

#include "spring_integrators.h"

namespace palpate::tissue {

std::vector<std::string> springSchemeNames() {
  std::vector<std::string> names{SpringSettings().scheme};
  for (const SpringIntegrator& integrator : springIntegrators())
    names.emplace_back(integrator.name);
  return names;
}

void describe(keys::FieldVisitor& v, SpringSettings& springs) {
  v.choice(
      {"constants", "",
       "Of each spring: E V/L^2 by the `volumes` V around edges of length L, `fitted` to the "
       "material by least squares over the directions at its ends, or as `file` says. Of model "
       "`cloth` a sheet that is read is always fitted, one that is made not by `volumes`."},
      springs.constants, {"volumes", "fitted", "file"});
  v.text({"file", "",
          "Network between the points of the organ's tetrahedra or sheet, as `palpate springs` "
          "writes it; a "
          "path as for `surface`."},
         springs.file);
  v.rule((springs.constants == "file") == !springs.file.empty(), "file",
         "is needed where constants is file, and only there");
  v.choice({"scheme", "",
            "`implicit`: as `solver` says; the others are explicit, in sub-steps. `forward_euler` "
            "and `trapezoidal_euler` need damping."},
           springs.scheme, springSchemeNames());
  v.number({"step", "s",
            "Longest sub-step of an explicit one; 0: nine tenths of what is stable "
            "in any shape."},
           springs.step, keys::Range::closed(0.0, 1.0));
  v.number({"region", "m",
            "Of an explicit one: only points that were so near a touched one at rest move, until "
            "all rest; 0: all."},
           springs.region, keys::Range::closed(0.0, 10.0));
}

}  // namespace palpate::tissue
