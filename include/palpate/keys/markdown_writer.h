// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "palpate/keys/fields.h"

namespace palpate::keys {

/// Markdown of the fields that `fields` visits: a heading per section, a table of keys (type, unit,
/// default, allowed values, meaning) and rules.
std::string fieldsMarkdown(const std::function<void(FieldVisitor&)>& fields);

}  // namespace palpate::keys
