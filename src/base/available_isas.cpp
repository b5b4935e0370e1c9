// SPDX-License-Identifier: GPL-3.0-or-later
// In a separate file, so that a test can replace it.
#include "detect_isas.h"

namespace palpate {

const std::vector<Isa>& availableIsas() {
  static const std::vector<Isa> kIsas = detectIsas();
  return kIsas;
}

}  // namespace palpate
