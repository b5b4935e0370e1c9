// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/damping_keys.h"

namespace palpate::solver {

void describe(keys::FieldVisitor& v, RayleighDamping& damping) {
  v.number({"mass", "1/s", "Force -(mass) M v, of all motion."}, damping.mass,
           keys::Range::closed(0.0, 1.0e6));
  v.number({"stiffness", "s", "Force -(stiffness) K v, of deformation."}, damping.stiffness,
           keys::Range::closed(0.0, 1.0e3));
}

}  // namespace palpate::solver
