// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "palpate/keys/fields.h"

namespace palpate::keys {

/// A key and its value.
struct KeyValue {
  std::string key;       ///< Full path: "contact.friction.pairs[0].static".
  std::string value;     ///< As in a file: "0.6", "true", "[0, 0, 0.1]"; numbers exact.
  bool is_text = false;  ///< Free text, for example a file name; false: a listed word.
};

inline bool operator==(const KeyValue& a, const KeyValue& b) {
  return a.key == b.key && a.value == b.value && a.is_text == b.is_text;
}

/// Values of all fields that `fields` visits, in its order, with defaults and every list item.
/// Omits unset fields without defaults and alternatives that are not chosen. Changes no field.
std::vector<KeyValue> fieldValues(const std::function<void(FieldVisitor&)>& fields);

}  // namespace palpate::keys
