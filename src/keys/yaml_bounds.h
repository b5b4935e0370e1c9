// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace palpate::keys {

/// Scans a YAML text before nodes are made, and refuses more than one document and excessive depth
/// or size. An alias counts as its whole content.
/// @throws InputError with the name of `file`; YAML::Exception for invalid YAML.
void checkYamlBounds(const std::string& file, const std::string& text);

}  // namespace palpate::keys
