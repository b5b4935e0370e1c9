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

/// What a key of an input file is called and means.
struct Field {
  std::string key;
  std::string unit;  ///< "m", "Pa"; empty for pure numbers and words.
  std::string doc;   ///< One sentence.
  Need need = Need::kOptional;
};

/// Three components of which some may be left open (`null` in a file).
using PartialVec3 = std::array<std::optional<double>, 3>;

/// Numbers, or lists of them, by key. A scalar is a list of one.
using NumberLists = std::map<std::string, std::vector<double>>;

/// What a choice may be set to, where each word has keys of its own: a law and its constants.
struct Kind {
  std::string name;
  std::vector<std::string> keys;
  std::string needs;  ///< What they have to be, in a sentence.
};

/// Walks over the keys of an input file.
///
/// A kind of file is described once, by a function `describe(FieldVisitor&, T&)` for each of its
/// structs in the struct's namespace, which names every key with unit, range and meaning. The
/// value that a field has before the visit is its default. The reader (yaml_reader.h), the
/// documentation (markdown_writer.h) and what tells all values (value_list.h) are visitors, so that
/// they cannot drift apart.
///
/// Functions that return bool tell whether the key stands in the file, right or wrong. What a
/// visitor does not reach keeps its value: a key that does not stand in the file, a whole list.
class FieldVisitor {
 public:
  virtual ~FieldVisitor() = default;

  virtual bool number(const Field& field, double& value, const Range& range) = 0;
  virtual bool integer(const Field& field, int& value, const Range& range) = 0;
  virtual bool flag(const Field& field, bool& value) = 0;
  virtual bool text(const Field& field, std::string& value) = 0;
  /// A word of letters, digits and _ that begins with a letter, as in topics and column heads.
  virtual bool name(const Field& field, std::string& value) = 0;
  virtual bool choice(const Field& field, std::string& value,
                      const std::vector<std::string>& allowed) = 0;
  /// Three numbers, each in the range.
  virtual bool vector3(const Field& field, Vec3& value, const Range& range) = 0;
  /// A list of at least `min_size` points, three numbers each, each in the range.
  virtual bool vectors3(const Field& field, std::vector<Vec3>& values, const Range& range,
                        int min_size) = 0;
  virtual bool integers3(const Field& field, Eigen::Vector3i& value, const Range& range) = 0;
  virtual bool partialVector3(const Field& field, PartialVec3& value, const Range& range) = 0;
  /// Keys of the present section that depend on what the choice `choice` was set to: `chosen`, the
  /// name of one of `kinds`; if it is none of them, the keys of all are allowed. False: nothing was
  /// read, or something that stands there is wrong.
  virtual bool numbersOfKind(const std::string& choice, const std::vector<Kind>& kinds,
                             const std::string& chosen, NumberLists& values) = 0;

  /// Fields without a default.
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

  /// Keys below `field.key`.
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

  /// Keys below `field.key`, or in their place a number, the short form of a section with nothing
  /// but that number, `number`, which is a part of `value`.
  template <class T>
  bool numberOrSection(const Field& field, double& number, const Range& range, T& value) {
    const Entered entered = enterNumberOrSection(field, number, range);
    if (entered.walk) {
      describe(*this, value);
      leaveSection();
    }
    return entered.given;
  }

  /// A list of sections, at least `min_size` of them.
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

  /// Keys that exist only if the section's earlier keys are so: `condition` says how, `chosen`
  /// whether they are.
  template <class Fields>
  void onlyIf(bool chosen, const std::string& condition, Fields&& fields) {
    beginAlternative(chosen, condition);
    fields();
    endAlternative();
  }

  /// What must hold between fields. `key` is where a user would look, from the present section
  /// ("" for the section itself).
  virtual void rule(bool holds, const std::string& key, const std::string& text) = 0;

  /// The rule that `name` differs between the items of the list `key`.
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
    bool given;  ///< The key stands in the file.
    bool walk;   ///< Describe what is below, then leaveSection().
  };
  virtual Entered enterSection(const Field& field) = 0;
  virtual Entered enterNumberOrSection(const Field& field, double& number, const Range& range) = 0;
  struct Items {
    int count;  ///< Of items to walk.
    bool anew;  ///< They take the place of those that are there; else they are the first of those.
  };
  /// `present`: of items that are there.
  virtual Items enterList(const Field& field, int min_size, int present) = 0;
  virtual bool enterItem(const Field& field, int index) = 0;  ///< As Entered::walk.
  virtual void leaveSection() = 0;
  virtual void beginAlternative(bool chosen, const std::string& condition) = 0;
  virtual void endAlternative() = 0;
  /// Around a field without a default, `set`: which has a value.
  virtual void beginOptional(bool /*set*/) {}
  virtual void endOptional() {}

 private:
  /// `none`: what a visitor sees in the place of a value.
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
