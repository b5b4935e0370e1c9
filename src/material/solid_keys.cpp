// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/material/solid_keys.h"

namespace palpate::material {

void describe(keys::FieldVisitor& v, PronyTerm& term) {
  v.number({"g", "", "Part of the distortional stress that relaxes.", keys::Need::kRequired},
           term.g, keys::Range::open(0.0, 1.0));
  v.number({"tau", "s", "Its time constant.", keys::Need::kRequired}, term.tau,
           keys::Range::above(0.0, 1.0e12));
}

}  // namespace palpate::material
