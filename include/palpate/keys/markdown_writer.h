// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "palpate/keys/fields.h"

namespace palpate::keys {

/// The fields that `fields` visits as Markdown: for each section a heading, a table of its keys
/// (type, unit, default, allowed values, meaning) and its rules.
std::string fieldsMarkdown(const std::function<void(FieldVisitor&)>& fields);

}  // namespace palpate::keys
