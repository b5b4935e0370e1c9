// SPDX-License-Identifier: GPL-3.0-or-later
#include "yaml_visitor.h"

#include <algorithm>
#include <utility>

#include "yaml_node.h"

namespace palpate::keys {
namespace {

std::string unitText(const Field& field) {
  return field.unit.empty() ? "" : " [" + field.unit + "]";
}

std::string mustBe(const std::string& what, const Field& field, const Range& range) {
  return "must be " + what + " " + range.text() + unitText(field);
}

bool isName(const std::string& text) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto inside = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_'; };
  return !text.empty() && letter(text[0]) && std::all_of(text.begin(), text.end(), inside);
}

}  // namespace

bool YamlVisitor::number(const Field& field, double& value, const Range& range) {
  const std::optional<YAML::Node> node = find(field);
  if (!node) return false;
  const std::optional<double> x = toNumber(*node);
  if (x && range.contains(*x)) {
    value = *x;
  } else {
    problem(field.key, *node, mustBe("a number", field, range));
  }
  return true;
}

bool YamlVisitor::integer(const Field& field, int& value, const Range& range) {
  const std::optional<YAML::Node> node = find(field);
  if (!node) return false;
  const std::optional<int> x = toInteger(*node);
  if (x && range.contains(*x)) {
    value = *x;
  } else {
    problem(field.key, *node, mustBe("a whole number", field, range));
  }
  return true;
}

bool YamlVisitor::flag(const Field& field, bool& value) {
  const std::optional<YAML::Node> node = find(field);
  if (!node) return false;
  const std::optional<bool> x = toFlag(*node);
  if (x) {
    value = *x;
  } else {
    problem(field.key, *node, "must be true or false");
  }
  return true;
}

bool YamlVisitor::text(const Field& field, std::string& value) {
  const std::optional<YAML::Node> node = find(field);
  if (!node) return false;
  if (node->IsScalar() && !node->Scalar().empty()) {
    value = node->Scalar();
  } else {
    problem(field.key, *node, "must be text, not empty");
  }
  return true;
}

bool YamlVisitor::name(const Field& field, std::string& value) {
  const std::optional<YAML::Node> node = find(field);
  if (!node) return false;
  if (node->IsScalar() && isName(node->Scalar())) {
    value = node->Scalar();
  } else {
    problem(field.key, *node,
            "must be a name of letters, digits and _ (no accents) that begins with a letter");
  }
  return true;
}

bool YamlVisitor::choice(const Field& field, std::string& value,
                         const std::vector<std::string>& allowed) {
  const std::optional<YAML::Node> node = find(field);
  if (!node) return false;
  const std::string word = node->IsScalar() ? node->Scalar() : "";
  if (std::count(allowed.begin(), allowed.end(), word)) {
    value = word;
    return true;
  }
  const std::string nearest = nearestName(word, allowed);
  problem(field.key, *node,
          "must be one of " + joinNames(allowed) +
              (nearest.empty() ? "" : " (did you mean " + nearest + "?)"));
  return true;
}

bool YamlVisitor::three(const Field& field, const std::string& what,
                        const std::function<bool(const YAML::Node&, int)>& component) {
  const std::optional<YAML::Node> node = find(field);
  if (!node) return false;
  bool good = node->IsSequence() && node->size() == 3;
  for (int i = 0; good && i < 3; ++i) good = component((*node)[i], i);
  if (!good) problem(field.key, *node, "must be a list of three " + what);
  return true;
}

bool YamlVisitor::vector3(const Field& field, Vec3& value, const Range& range) {
  Vec3 read = value;
  const bool given =
      three(field, "numbers " + range.text() + unitText(field), [&](const YAML::Node& node, int i) {
        const std::optional<double> x = toNumber(node);
        if (x) read(i) = *x;
        return x && range.contains(*x);
      });
  value = read;
  return given;
}

bool YamlVisitor::vectors3(const Field& field, std::vector<Vec3>& values, const Range& range,
                           int min_size) {
  const std::optional<YAML::Node> node = find(field);
  if (!node) return false;
  bool good = node->IsSequence() && static_cast<int>(node->size()) >= min_size;
  std::vector<Vec3> read(good ? node->size() : 0);
  for (std::size_t k = 0; good && k < read.size(); ++k) {
    const YAML::Node item = (*node)[k];
    good = item.IsSequence() && item.size() == 3;
    for (int i = 0; good && i < 3; ++i) {
      const std::optional<double> x = toNumber(item[i]);
      good = x && range.contains(*x);
      if (good) read[k](i) = *x;
    }
  }
  if (good) {
    values = read;
  } else {
    problem(field.key, *node,
            "must be a list of points, at least " + std::to_string(min_size) +
                ", each three numbers " + range.text() + unitText(field));
  }
  return true;
}

bool YamlVisitor::integers3(const Field& field, Eigen::Vector3i& value, const Range& range) {
  Eigen::Vector3i read = value;
  const bool given = three(field, "whole numbers " + range.text() + unitText(field),
                           [&](const YAML::Node& node, int i) {
                             const std::optional<int> x = toInteger(node);
                             if (x) read(i) = *x;
                             return x && range.contains(*x);
                           });
  value = read;
  return given;
}

bool YamlVisitor::partialVector3(const Field& field, PartialVec3& value, const Range& range) {
  PartialVec3 read = value;
  const bool given = three(field, "numbers " + range.text() + unitText(field) + " or null",
                           [&](const YAML::Node& node, int i) {
                             const std::optional<double> x = toNumber(node);
                             read[static_cast<std::size_t>(i)] = x;
                             return node.IsNull() || (x && range.contains(*x));
                           });
  value = read;
  return given;
}

}  // namespace palpate::keys
