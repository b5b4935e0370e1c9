// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/keys/fields.h"

namespace palpate::tissue {

/// Two organs by their names; the same one twice: the organ itself.
struct OrganPair {
  std::string organ, other;
};

/// Which organs may touch.
struct TouchingOrgans {
  bool organs = true;            ///< Organs touch each other.
  bool self = false;             ///< Where they fold, themselves.
  std::vector<OrganPair> apart;  ///< But for these.

  bool mayTouch(const std::string& a, const std::string& b) const;
};

void describe(keys::FieldVisitor& v, OrganPair& pair);
void describe(keys::FieldVisitor& v, TouchingOrgans& touching);

}  // namespace palpate::tissue
