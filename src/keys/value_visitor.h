// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/keys/value_list.h"

namespace palpate::keys {

/// Lists the values of visited fields. A field with a value counts as given, so alternatives are
/// chosen as when the file was read.
class ValueVisitor : public FieldVisitor {
 public:
  std::vector<KeyValue> take() { return std::move(values_); }

  bool number(const Field& field, double& value, const Range& range) override;
  bool integer(const Field& field, int& value, const Range& range) override;
  bool flag(const Field& field, bool& value) override;
  bool text(const Field& field, std::string& value) override;
  bool name(const Field& field, std::string& value) override;
  bool choice(const Field& field, std::string& value,
              const std::vector<std::string>& allowed) override;
  bool vector3(const Field& field, Vec3& value, const Range& range) override;
  bool vectors3(const Field& field, std::vector<Vec3>& values, const Range& range,
                int min_size) override;
  bool integers3(const Field& field, Eigen::Vector3i& value, const Range& range) override;
  bool partialVector3(const Field& field, PartialVec3& value, const Range& range) override;
  bool numbersOfKind(const std::string& choice, const std::vector<Kind>& kinds,
                     const std::string& chosen, NumberLists& values) override;
  void rule(bool holds, const std::string& key, const std::string& text) override;

 protected:
  Entered enterSection(const Field& field) override;
  Entered enterNumberOrSection(const Field& field, double& number, const Range& range) override;
  Items enterList(const Field& field, int min_size, int present) override;
  bool enterItem(const Field& field, int index) override;
  void leaveSection() override;
  void beginAlternative(bool chosen, const std::string& condition) override;
  void endAlternative() override;
  void beginOptional(bool set) override;
  void endOptional() override;

 private:
  bool hidden() const;
  bool add(const Field& field, const std::string& value, bool given = true, bool is_text = false);
  void open(const std::string& key);

  std::vector<KeyValue> values_;
  std::vector<std::string> open_;  // paths of the enclosing sections, with a dot
  std::vector<bool> shown_;        // of the enclosing alternatives and optional fields
};

}  // namespace palpate::keys
