// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

namespace palpate::io {

/// A JSON string: in quotes, with what must be escaped.
std::string jsonText(const std::string& text);
/// As many digits as bring back the same bits; null for what is no finite number.
std::string json(double value);
/// [a, b, ...].
std::string json(const Eigen::Ref<const Eigen::VectorXd>& values);

/// Members of a JSON object, one after the other.
class JsonMembers {
 public:
  explicit JsonMembers(const std::string& separator = ", ") : separator_(separator) {}

  /// `value` is JSON already.
  void add(const std::string& key, const std::string& value) {
    text_ += (text_.empty() ? "" : separator_) + jsonText(key) + ": " + value;
  }
  void add(const std::string& key, double value) { add(key, json(value)); }
  /// Nothing where there is no value.
  template <class T>
  void add(const std::string& key, const std::optional<T>& value) {
    if (value) add(key, json(*value));
  }
  const std::string& text() const { return text_; }
  /// The object.
  std::string object() const { return "{" + text_ + "}"; }

 private:
  std::string separator_, text_;
};

}  // namespace palpate::io
