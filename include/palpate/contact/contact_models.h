// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/contact/response_settings.h"

namespace palpate::contact {

/// What a scene may name as contact: responseNames(), and `prescribed`, which is no response: the
/// tool is a segment, and a method of finite elements prescribes displacements where it meets the
/// surface.
std::vector<std::string> contactModelNames();
bool isPrescribed(const ResponseSettings& settings);

}  // namespace palpate::contact
