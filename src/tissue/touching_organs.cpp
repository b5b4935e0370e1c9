// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/touching_organs.h"

#include <algorithm>

namespace palpate::tissue {

bool TouchingOrgans::mayTouch(const std::string& a, const std::string& b) const {
  return organs && std::none_of(apart.begin(), apart.end(), [&](const OrganPair& pair) {
           return (pair.organ == a && pair.other == b) || (pair.organ == b && pair.other == a);
         });
}

void describe(keys::FieldVisitor& v, OrganPair& pair) {
  v.text({"organ", "", "Name of one organ.", keys::Need::kRequired}, pair.organ);
  v.text({"other", "", "Name of the other one; the same: the organ does not touch itself.",
          keys::Need::kRequired},
         pair.other);
}

void describe(keys::FieldVisitor& v, TouchingOrgans& touching) {
  v.flag({"organs", "",
          "Organs of model `fem` touch each other, and those that may are solved together; false: "
          "they pass through each other."},
         touching.organs);
  v.flag(
      {"self", "",
       "Parts of an organ that were apart at rest touch each other where it folds; only together "
       "with `organs`. All organs are then searched for folds in every cycle."},
      touching.self);
  v.list({"apart", "", "Pairs of organs that do not touch all the same."}, touching.apart, 0);
}

}  // namespace palpate::tissue
