// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/keys/fields.h"

namespace palpate::keys {

/// Writes visited fields as tables. No field is "in the file"; every section and alternative is
/// visited once, a list as one item.
class MarkdownVisitor : public FieldVisitor {
 public:
  MarkdownVisitor();

  std::string markdown() const;

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

 private:
  struct Table {
    std::string path;  // "organs[].material"; "" for the file
    std::string rows;
    std::vector<std::string> rules;
    std::string after;      // text below
    std::string condition;  // of the present keys
  };

  Table& here() { return tables_[open_.back()]; }
  void row(const Field& field, const std::string& type, const std::string& default_value,
           const std::string& allowed);
  void pushTable(const std::string& key);

  std::vector<Table> tables_;      // in order of opening
  std::vector<std::size_t> open_;  // indices of the enclosing sections
};

}  // namespace palpate::keys
