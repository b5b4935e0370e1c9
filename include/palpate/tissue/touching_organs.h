// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/keys/fields.h"

namespace palpate::tissue {

/// Names of two organs; twice the same name: self-contact of an organ.
struct OrganPair {
  std::string organ, other;
};

/// Pairs of organs that may touch.
struct TouchingOrgans {
  bool organs = true;            ///< Whether organs touch each other.
  bool self = false;             ///< Whether organs touch themselves.
  std::vector<OrganPair> apart;  ///< Pairs without contact.

  bool mayTouch(const std::string& a, const std::string& b) const;
};

void describe(keys::FieldVisitor& v, OrganPair& pair);
void describe(keys::FieldVisitor& v, TouchingOrgans& touching);

}  // namespace palpate::tissue
