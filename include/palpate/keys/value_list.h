// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "palpate/keys/fields.h"

namespace palpate::keys {

/// A key and what it is set to.
struct KeyValue {
  std::string key;       ///< From the top: "contact.friction.pairs[0].static".
  std::string value;     ///< As a file has it: "0.6", "true", "[0, 0, 0.1]"; numbers to the bit.
  bool is_text = false;  ///< Any text, the name of a file perhaps; not a word out of a few.
};

inline bool operator==(const KeyValue& a, const KeyValue& b) {
  return a.key == b.key && a.value == b.value && a.is_text == b.is_text;
}

/// All fields that `fields` visits, in its order, with their values: also defaults, and each item
/// of a list. Fields without a default that have no value are left out, and so are those of
/// alternatives that are not chosen. The values stay as they are.
std::vector<KeyValue> fieldValues(const std::function<void(FieldVisitor&)>& fields);

}  // namespace palpate::keys
