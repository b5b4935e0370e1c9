// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/contact/response_settings.h"

namespace palpate::contact {

/// Values of the key contact.model: responseNames(), and `prescribed`, by which a method of finite
/// elements prescribes displacements where a tool segment meets the surface.
std::vector<std::string> contactModelNames();
bool isPrescribed(const ResponseSettings& settings);

}  // namespace palpate::contact
