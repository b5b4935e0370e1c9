// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/keys/range.h"

namespace palpate::keys {

enum class Need { kOptional, kRequired };

/// Name and meaning of a key of an input file.
struct Field {
  std::string key;
  std::string unit;  ///< "m", "Pa"; empty for pure numbers and words.
  std::string doc;   ///< One sentence.
  Need need = Need::kOptional;
};

/// A vector with optional components (`null` in a file).
using PartialVec3 = std::array<std::optional<double>, 3>;

/// Numbers or lists of numbers by key. A scalar is a list of one.
using NumberLists = std::map<std::string, std::vector<double>>;

/// A value of a choice that has its own keys, for example a law and its constants.
struct Kind {
  std::string name;
  std::vector<std::string> keys;
  std::string needs;  ///< Requirement on the keys, as a sentence.
};

/// Visits the keys of an input file.
///
/// Each struct of a file has one function `describe(FieldVisitor&, T&)` in its namespace, which
/// names every key with unit, range and meaning. A field's value before the visit is its default.
/// The reader (yaml_reader.h), the documentation (markdown_writer.h) and the list of values
/// (value_list.h) are visitors, so they always agree.
///
/// Functions returning bool tell whether the key is in the file, valid or not. Fields whose keys
/// are absent keep their values, also whole lists.
class FieldVisitor {
 public:
  virtual ~FieldVisitor() = default;

  virtual bool number(const Field& field, double& value, const Range& range) = 0;
  virtual bool integer(const Field& field, int& value, const Range& range) = 0;
  virtual bool flag(const Field& field, bool& value) = 0;
  virtual bool text(const Field& field, std::string& value) = 0;
  /// An identifier of letters, digits and _, as in topics and column heads; begins with a letter.
  virtual bool name(const Field& field, std::string& value) = 0;
  virtual bool choice(const Field& field, std::string& value,
                      const std::vector<std::string>& allowed) = 0;
  /// Three numbers within the range.
  virtual bool vector3(const Field& field, Vec3& value, const Range& range) = 0;
  /// A list of at least `min_size` points of three numbers within the range.
  virtual bool vectors3(const Field& field, std::vector<Vec3>& values, const Range& range,
                        int min_size) = 0;
  virtual bool integers3(const Field& field, Eigen::Vector3i& value, const Range& range) = 0;
  virtual bool partialVector3(const Field& field, PartialVec3& value, const Range& range) = 0;
  /// Keys of the present section that depend on the choice `choice`: `chosen` names one of `kinds`;
  /// for any other name, the keys of all kinds are allowed. Returns false if nothing was read or
  /// something is invalid.
  virtual bool numbersOfKind(const std::string& choice, const std::vector<Kind>& kinds,
                             const std::string& chosen, NumberLists& values) = 0;

  /// Fields without defaults.
  bool number(const Field& field, std::optional<double>& value, const Range& range) {
    return optionalKey(value, std::numeric_limits<double>::quiet_NaN(),
                       [&](double& x) { return number(field, x, range); });
  }
  bool integer(const Field& field, std::optional<int>& value, const Range& range) {
    return optionalKey(value, 0, [&](int& x) { return integer(field, x, range); });
  }
  bool vector3(const Field& field, std::optional<Vec3>& value, const Range& range) {
    const Vec3 none = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    return optionalKey(value, none, [&](Vec3& x) { return vector3(field, x, range); });
  }
  bool partialVector3(const Field& field, std::optional<PartialVec3>& value, const Range& range) {
    return optionalKey(value, PartialVec3{},
                       [&](PartialVec3& x) { return partialVector3(field, x, range); });
  }

  /// A section of keys below `field.key`.
  template <class T>
  bool section(const Field& field, T& value) {
    const Entered entered = enterSection(field);
    if (entered.walk) {
      describe(*this, value);
      leaveSection();
    }
    return entered.given;
  }
  template <class T>
  bool section(const Field& field, std::optional<T>& value) {
    return optionalKey(value, T(), [&](T& x) { return section(field, x); });
  }

  /// A section below `field.key`, or its short form: the number `number`, which is part of `value`.
  template <class T>
  bool numberOrSection(const Field& field, double& number, const Range& range, T& value) {
    const Entered entered = enterNumberOrSection(field, number, range);
    if (entered.walk) {
      describe(*this, value);
      leaveSection();
    }
    return entered.given;
  }

  /// A list of at least `min_size` sections.
  template <class T>
  void list(const Field& field, std::vector<T>& items, int min_size) {
    const Items walked = enterList(field, min_size, static_cast<int>(items.size()));
    if (walked.anew) items.assign(static_cast<std::size_t>(walked.count), T());
    for (int i = 0; i < walked.count; ++i) {
      if (!enterItem(field, i)) continue;
      describe(*this, items[static_cast<std::size_t>(i)]);
      leaveSection();
    }
  }

  /// Keys that depend on earlier keys of the section: `condition` states how, `chosen` whether it
  /// holds.
  template <class Fields>
  void onlyIf(bool chosen, const std::string& condition, Fields&& fields) {
    beginAlternative(chosen, condition);
    fields();
    endAlternative();
  }

  /// A rule between fields. `key` is where a user would look, relative to the present section (""
  /// for the section itself).
  virtual void rule(bool holds, const std::string& key, const std::string& text) = 0;

  /// Rule: items of the list `key` have different values of `name`.
  template <class T>
  void uniqueNames(const std::string& key, const std::vector<T>& items) {
    const std::string text = "names in " + key + " must differ";
    rule(true, key, text);
    std::set<std::string> seen;
    for (std::size_t i = 0; i < items.size(); ++i) {
      const bool fresh = items[i].name.empty() || seen.insert(items[i].name).second;
      if (!fresh) rule(false, key + "[" + std::to_string(i) + "].name", text);
    }
  }

 protected:
  struct Entered {
    bool given;  ///< Whether the key is in the file.
    bool walk;   ///< Whether to describe the content and call leaveSection().
  };
  virtual Entered enterSection(const Field& field) = 0;
  virtual Entered enterNumberOrSection(const Field& field, double& number, const Range& range) = 0;
  struct Items {
    int count;  ///< Number of items to visit.
    bool anew;  ///< Whether these items replace the present ones; else they are the first of them.
  };
  /// `present`: number of present items.
  virtual Items enterList(const Field& field, int min_size, int present) = 0;
  virtual bool enterItem(const Field& field, int index) = 0;  ///< As Entered::walk.
  virtual void leaveSection() = 0;
  virtual void beginAlternative(bool chosen, const std::string& condition) = 0;
  virtual void endAlternative() = 0;
  /// Encloses a field without default; `set`: whether it has a value.
  virtual void beginOptional(bool /*set*/) {}
  virtual void endOptional() {}

 private:
  /// `none`: shown to visitors instead of a missing value.
  template <class T, class Visit>
  bool optionalKey(std::optional<T>& value, const T& none, Visit&& visit) {
    T x = value.value_or(none);
    beginOptional(value.has_value());
    const bool given = visit(x);
    endOptional();
    if (given) value = x;
    return given;
  }
};

}  // namespace palpate::keys
