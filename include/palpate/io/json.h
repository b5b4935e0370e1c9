// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

namespace palpate::io {

/// A quoted and escaped JSON string.
std::string jsonText(const std::string& text);
/// Digits that are read back exactly; null for non-finite values.
std::string json(double value);
/// Array [a, b, ...].
std::string json(const Eigen::Ref<const Eigen::VectorXd>& values);

/// Members of a JSON object, in order.
class JsonMembers {
 public:
  explicit JsonMembers(const std::string& separator = ", ") : separator_(separator) {}

  /// @pre `value` is JSON.
  void add(const std::string& key, const std::string& value) {
    text_ += (text_.empty() ? "" : separator_) + jsonText(key) + ": " + value;
  }
  void add(const std::string& key, double value) { add(key, json(value)); }
  /// Adds nothing for an empty value.
  template <class T>
  void add(const std::string& key, const std::optional<T>& value) {
    if (value) add(key, json(*value));
  }
  const std::string& text() const { return text_; }
  /// The complete object.
  std::string object() const { return "{" + text_ + "}"; }

 private:
  std::string separator_, text_;
};

}  // namespace palpate::io
