// SPDX-License-Identifier: GPL-3.0-or-later
#include <set>

#include "yaml_node.h"
#include "yaml_visitor.h"

namespace palpate::keys {
namespace {

constexpr std::size_t kMaxProblems = 50;  // limit of reported problems
constexpr int kMostItems = 2000;

std::string didYouMean(const std::string& nearest) {
  return nearest.empty() ? "" : " (did you mean " + nearest + "?)";
}

// Keys of the chosen kind. For an invalid choice the keys of all kinds, so that one mistake gives
// one problem.
std::set<std::string> keysOf(const std::vector<Kind>& kinds, const std::string& chosen) {
  std::set<std::string> all;
  for (const Kind& kind : kinds) {
    if (kind.name == chosen) return {kind.keys.begin(), kind.keys.end()};
    all.insert(kind.keys.begin(), kind.keys.end());
  }
  return all;
}

// A number or a list of numbers; empty for anything else.
std::optional<std::vector<double>> toNumbers(const YAML::Node& node) {
  std::vector<double> values;
  if (!node.IsSequence()) {
    const std::optional<double> x = toNumber(node);
    if (!x) return {};
    return std::vector<double>{*x};
  }
  for (const YAML::Node& item : node) {
    const std::optional<double> x = toNumber(item);
    if (!x) return {};
    values.push_back(*x);
  }
  return values;
}

}  // namespace

YamlVisitor::YamlVisitor(const YAML::Node& root) { pushLevel(root, ""); }

std::vector<Problem> YamlVisitor::finish() {
  leaveSection();
  if (num_problems_ > kMaxProblems) {
    problems_.push_back({"", "", "and " + std::to_string(num_problems_ - kMaxProblems) + " more"});
  }
  return problems_;
}

void YamlVisitor::pushLevel(const YAML::Node& map, const std::string& path) {
  levels_.push_back({map, path, {}, {}, {}});
  Level& level = levels_.back();
  for (const auto& entry : map) {
    if (!entry.first.IsScalar()) {
      problem("", entry.first, "must be a plain word, as every key");
    } else if (!level.given.emplace(entry.first.Scalar(), entry.second).second) {
      problemAt(shown(entry.first), "stands twice" + lineOf(entry.first));
    }
  }
}

std::optional<YAML::Node> YamlVisitor::find(const Field& field) {
  Level& level = levels_.back();
  if (!skipped_condition_.empty()) {
    level.elsewhere.emplace(field.key, skipped_condition_);
    return {};
  }
  level.known.insert(field.key);
  const auto found = level.given.find(field.key);
  if (found != level.given.end()) return found->second;
  if (field.need == Need::kRequired) {
    problemAt(field.key, "is missing: " + field.doc +
                             (field.unit.empty() ? "" : " [" + field.unit + "]") +
                             lineOf(level.map));
  }
  return {};
}

std::string YamlVisitor::pathOf(const std::string& key) const {
  std::string path = levels_.back().path + key;
  if (key.empty() && !path.empty()) path.pop_back();  // the section itself: without dot
  return path;
}

void YamlVisitor::problem(const std::string& key, const YAML::Node& node,
                          const std::string& allowed) {
  if (++num_problems_ > kMaxProblems) return;
  problems_.push_back({pathOf(key), shown(node), allowed + lineOf(node)});
}

void YamlVisitor::problemAt(const std::string& key, const std::string& allowed) {
  if (++num_problems_ > kMaxProblems) return;
  problems_.push_back({pathOf(key), "", allowed});
}

void YamlVisitor::rule(bool holds, const std::string& key, const std::string& text) {
  if (holds || !skipped_condition_.empty()) return;
  const Level& level = levels_.back();
  const std::optional<YAML::Node> node = findPath(level.map, key);
  if (node) {
    problem(key, *node, text);
  } else {
    problemAt(key, text + lineOf(level.map));
  }
}

bool YamlVisitor::numbersOfKind(const std::string&, const std::vector<Kind>& kinds,
                                const std::string& chosen, NumberLists& values) {
  const std::size_t problems_before = num_problems_;
  const bool skipped = !skipped_condition_.empty();
  for (const std::string& name : keysOf(kinds, skipped ? "" : chosen)) {
    const std::optional<YAML::Node> node = find({name, "", ""});
    if (!node) continue;
    const std::optional<std::vector<double>> numbers = toNumbers(*node);
    if (numbers) {
      values[name] = *numbers;
    } else {
      problem(name, *node, "must be a number or a list of numbers, finite");
    }
  }
  return !skipped && num_problems_ == problems_before;
}

FieldVisitor::Entered YamlVisitor::enterSection(const Field& field) {
  const std::optional<YAML::Node> node = find(field);
  if (!node) return {false, false};
  if (!node->IsMap()) {
    problem(field.key, *node, "must be a section, keys with values");
    return {true, false};
  }
  pushLevel(*node, levels_.back().path + field.key + ".");
  return {true, true};
}

FieldVisitor::Entered YamlVisitor::enterNumberOrSection(const Field& field, double& number,
                                                        const Range& range) {
  const std::optional<YAML::Node> node = find(field);
  if (!node) return {false, false};
  if (node->IsMap()) {
    pushLevel(*node, levels_.back().path + field.key + ".");
    return {true, true};
  }
  const std::optional<double> x = toNumber(*node);
  if (x && range.contains(*x)) {
    number = *x;
  } else {
    const std::string unit = field.unit.empty() ? "" : " [" + field.unit + "]";
    problem(field.key, *node,
            "must be a number " + range.text() + unit + ", or a section, keys with values");
  }
  return {true, false};
}

FieldVisitor::Items YamlVisitor::enterList(const Field& field, int min_size, int) {
  const std::optional<YAML::Node> node = find(field);
  if (!node) return {0, false};
  if (!node->IsSequence()) {
    problem(field.key, *node, "must be a list, items after `-`");
    return {0, true};
  }
  const int size = static_cast<int>(node->size());
  if (size > kMostItems) {
    problem(field.key, *node, "must have at most " + std::to_string(kMostItems) + " items");
    return {0, true};
  }
  if (size < min_size) {
    problem(field.key, *node, "must have at least " + std::to_string(min_size) + " item");
  }
  return {size, true};
}

bool YamlVisitor::enterItem(const Field& field, int index) {
  const Level& level = levels_.back();
  const std::string key = field.key + "[" + std::to_string(index) + "]";
  const YAML::Node item = level.given.at(field.key)[index];
  if (!item.IsMap()) {
    problem(key, item, "must be a section, keys with values");
    return false;
  }
  pushLevel(item, level.path + key + ".");
  return true;
}

void YamlVisitor::leaveSection() {
  reportUnknownKeys();
  levels_.pop_back();
}

void YamlVisitor::reportUnknownKeys() {
  const Level& level = levels_.back();
  const std::vector<std::string> names(level.known.begin(), level.known.end());
  for (const auto& entry : level.map) {
    if (!entry.first.IsScalar()) continue;
    const std::string key = entry.first.Scalar();
    if (level.known.count(key)) continue;
    const auto other = level.elsewhere.find(key);
    if (num_problems_ >= kMaxProblems) {  // further problems are not reported
      ++num_problems_;
      continue;
    }
    const std::string why = other != level.elsewhere.end()
                                ? "is a key only with " + other->second
                                : "no such key" + didYouMean(nearestName(key, names));
    problemAt(key.substr(0, 60), why + "; known here: " + joinNames(names) + lineOf(entry.first));
  }
}

void YamlVisitor::beginAlternative(bool chosen, const std::string& condition) {
  if (!chosen) skipped_condition_ = condition;
}

void YamlVisitor::endAlternative() { skipped_condition_.clear(); }

}  // namespace palpate::keys
