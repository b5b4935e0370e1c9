// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <yaml-cpp/yaml.h>

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/keys/fields.h"

namespace palpate::keys {

/// Reads visited fields from a YAML map and collects problems.
class YamlVisitor : public FieldVisitor {
 public:
  explicit YamlVisitor(const YAML::Node& root);

  /// Ends the visit. @returns all problems, in the order of the visit.
  std::vector<Problem> finish();

  using FieldVisitor::integer;
  using FieldVisitor::number;
  using FieldVisitor::partialVector3;
  using FieldVisitor::vector3;
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
  struct Level {
    YAML::Node map;
    std::string path;                              // "organs[0].", with the dot
    std::map<std::string, YAML::Node> given;       // first occurrence of each key in the file
    std::set<std::string> known;                   // visited keys
    std::map<std::string, std::string> elsewhere;  // keys not chosen: their condition
  };

  void pushLevel(const YAML::Node& map, const std::string& path);
  /// Finds the field's node and marks its key as known. Empty if absent.
  std::optional<YAML::Node> find(const Field& field);
  std::string pathOf(const std::string& key) const;
  void problem(const std::string& key, const YAML::Node& node, const std::string& allowed);
  void problemAt(const std::string& key, const std::string& allowed);
  void reportUnknownKeys();
  /// Reads a list of three by `component(node, i)`, which returns whether it succeeded.
  bool three(const Field& field, const std::string& what,
             const std::function<bool(const YAML::Node&, int)>& component);

  std::vector<Level> levels_;
  std::vector<Problem> problems_;  // first kMaxProblems of them
  std::size_t num_problems_ = 0;
  std::string skipped_condition_;  // of the enclosing alternative, which was not chosen
};

}  // namespace palpate::keys
