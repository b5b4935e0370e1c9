// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "palpate/keys/fields.h"

namespace palpate::keys {

/// Reads a YAML file into the fields that `fields` visits.
/// @throws InputError with all problems of the file: unreadable, not YAML, empty, unknown or
/// duplicate keys, wrong types, values out of range, missing keys, violated rules.
void readYaml(const std::string& file, const std::function<void(FieldVisitor&)>& fields);

}  // namespace palpate::keys
