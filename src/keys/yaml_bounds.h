// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace palpate::keys {

/// Goes once through a YAML text before anything is made of it, so that nodes are made only of what
/// is one document, of a depth and size that a file of keys can have. An alias counts as all that
/// it stands for.
/// @throws InputError in the name of `file`; YAML::Exception for what is no YAML.
void checkYamlBounds(const std::string& file, const std::string& text);

}  // namespace palpate::keys
