// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/contact_models.h"

#include "palpate/contact/response.h"

namespace palpate::contact {
namespace {

constexpr const char* kPrescribed = "prescribed";

}  // namespace

std::vector<std::string> contactModelNames() {
  std::vector<std::string> names = responseNames();
  names.emplace_back(kPrescribed);
  return names;
}

bool isPrescribed(const ResponseSettings& settings) { return settings.model == kPrescribed; }

}  // namespace palpate::contact
