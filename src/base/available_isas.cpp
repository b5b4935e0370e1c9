// SPDX-License-Identifier: GPL-3.0-or-later
// Alone in its file, so that a test may have one of its own in its place.
#include "detect_isas.h"

namespace palpate {

const std::vector<Isa>& availableIsas() {
  static const std::vector<Isa> kIsas = detectIsas();
  return kIsas;
}

}  // namespace palpate
