// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdexcept>

#include "augmented_response.h"
#include "friction_response.h"
#include "palpate/base/error.h"
#include "palpate/contact/response.h"
#include "penalty_response.h"

namespace palpate::contact {
namespace {

std::vector<std::string> namesOf(const std::vector<ResponseEntry>& table) {
  std::vector<std::string> names;
  names.reserve(table.size());
  for (const ResponseEntry& entry : table) names.push_back(entry.name);
  return names;
}

}  // namespace

// To add one: write its header and source, add it here.
const std::vector<ResponseEntry>& responses() {
  static const std::vector<ResponseEntry> kResponses = {
      {"augmented_lagrangian", makeAugmentedResponse},
      {"penalty", makePenaltyResponse},
  };
  return kResponses;
}

std::vector<std::string> responseNames() { return namesOf(responses()); }

std::unique_ptr<Response> makeResponse(const ResponseSettings& settings,
                                       const std::vector<ResponseEntry>& table) {
  for (const ResponseEntry& entry : table) {
    if (settings.model != entry.name) continue;
    if (!settings.friction_with.any()) return entry.make(settings);
    return withFriction(entry.make(settings), settings);
  }
  throw std::invalid_argument("contact.model = " + settings.model + ": must be one of " +
                              joinNames(namesOf(table)));
}

}  // namespace palpate::contact
