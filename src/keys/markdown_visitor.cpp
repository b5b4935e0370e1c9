// SPDX-License-Identifier: GPL-3.0-or-later
#include "markdown_visitor.h"

#include <algorithm>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/base/number.h"
#include "palpate/keys/markdown_writer.h"

namespace palpate::keys {
namespace {

const char* const kNone = "-";

std::string code(const std::string& text) { return text.empty() ? kNone : "`" + text + "`"; }

std::string numberText(double value) { return std::isnan(value) ? "" : formatNumber(value); }

template <class Vector>
std::string vectorText(const Vector& v) {
  if (std::isnan(static_cast<double>(v(0)))) return "";
  std::string text;
  for (int i = 0; i < 3; ++i) text += (i ? ", " : "") + formatNumber(static_cast<double>(v(i)));
  return "[" + text + "]";
}

}  // namespace

std::string fieldsMarkdown(const std::function<void(FieldVisitor&)>& fields) {
  MarkdownVisitor visitor;
  fields(visitor);
  return visitor.markdown();
}

MarkdownVisitor::MarkdownVisitor() { pushTable(""); }

std::string MarkdownVisitor::markdown() const {
  std::string text;
  for (const Table& table : tables_) {
    text += "\n## " + (table.path.empty() ? "The file" : "`" + table.path + "`") + "\n\n";
    text += "| key | type | unit | default | allowed | meaning |\n|---|---|---|---|---|---|\n";
    text += table.rows;
    if (!table.rules.empty()) text += "\nRules:\n\n";
    for (const std::string& rule : table.rules) text += "- " + rule + "\n";
    if (!table.after.empty()) text += "\n" + table.after;
  }
  return text;
}

void MarkdownVisitor::row(const Field& field, const std::string& type,
                          const std::string& default_value, const std::string& allowed) {
  const bool required = field.need == Need::kRequired;
  here().rows +=
      "| " + code(field.key) + " | " + type + " | " + (field.unit.empty() ? kNone : field.unit) +
      " | " + (required ? "**required**" : code(default_value)) + " | " +
      (allowed.empty() ? kNone : allowed) + " | " +
      (here().condition.empty() ? "" : "With " + here().condition + ": ") + field.doc + " |\n";
}

bool MarkdownVisitor::number(const Field& field, double& value, const Range& range) {
  row(field, "number", numberText(value), range.text());
  return false;
}

bool MarkdownVisitor::integer(const Field& field, int& value, const Range& range) {
  row(field, "whole number", std::to_string(value), range.text());
  return false;
}

bool MarkdownVisitor::flag(const Field& field, bool& value) {
  row(field, "flag", value ? "true" : "false", "true, false");
  return false;
}

bool MarkdownVisitor::text(const Field& field, std::string& value) {
  row(field, "text", value, "");
  return false;
}

bool MarkdownVisitor::name(const Field& field, std::string& value) {
  row(field, "name", value, "letters, digits, _; a letter first");
  return false;
}

bool MarkdownVisitor::choice(const Field& field, std::string& value,
                             const std::vector<std::string>& allowed) {
  std::string words;
  for (const std::string& word : allowed) words += (words.empty() ? "" : ", ") + code(word);
  row(field, "word", value, words);
  return false;
}

bool MarkdownVisitor::vector3(const Field& field, Vec3& value, const Range& range) {
  row(field, "three numbers", vectorText(value), "each " + range.text());
  return false;
}

bool MarkdownVisitor::vectors3(const Field& field, std::vector<Vec3>&, const Range& range,
                               int min_size) {
  row(field, "list of points", "",
      "at least " + std::to_string(min_size) + ", each three numbers " + range.text());
  return false;
}

bool MarkdownVisitor::integers3(const Field& field, Eigen::Vector3i& value, const Range& range) {
  row(field, "three whole numbers", vectorText(value), "each " + range.text());
  return false;
}

bool MarkdownVisitor::partialVector3(const Field& field, PartialVec3&, const Range& range) {
  row(field, "three numbers or null", "", "each " + range.text() + ", or null");
  return false;
}

bool MarkdownVisitor::numbersOfKind(const std::string& choice, const std::vector<Kind>& kinds,
                                    const std::string&, NumberLists&) {
  std::string& text = here().after;
  text += "Besides, the constants of the " + choice + ", numbers or lists of numbers:\n\n";
  text += "| " + choice + " | constants | rule |\n|---|---|---|\n";
  for (const Kind& kind : kinds) {
    std::string names;
    for (const std::string& key : kind.keys) names += (names.empty() ? "" : ", ") + code(key);
    text += "| " + code(kind.name) + " | " + names + " | " + kind.needs + " |\n";
  }
  return false;
}

void MarkdownVisitor::rule(bool, const std::string& key, const std::string& text) {
  std::vector<std::string>& rules = here().rules;
  const std::string line =
      (key.empty() || text.find(key) != std::string::npos ? "" : code(key) + ": ") + text;
  if (!std::count(rules.begin(), rules.end(), line)) rules.push_back(line);
}

void MarkdownVisitor::pushTable(const std::string& key) {
  std::string path = open_.empty() ? "" : here().path;
  path += (path.empty() ? "" : ".") + key;
  open_.push_back(tables_.size());
  tables_.push_back({path, "", {}, "", ""});
}

FieldVisitor::Entered MarkdownVisitor::enterSection(const Field& field) {
  row(field, "section", "", "");
  pushTable(field.key);
  return {false, true};
}

FieldVisitor::Entered MarkdownVisitor::enterNumberOrSection(const Field& field, double& number,
                                                            const Range& range) {
  row(field, "number or section", numberText(number), range.text());
  pushTable(field.key);
  return {false, true};
}

FieldVisitor::Items MarkdownVisitor::enterList(const Field& field, int min_size, int) {
  row(field, "list of sections", "",
      min_size > 0 ? "at least " + std::to_string(min_size) : "may be empty");
  return {1, true};
}

bool MarkdownVisitor::enterItem(const Field& field, int) {
  pushTable(field.key + "[]");
  return true;
}

void MarkdownVisitor::leaveSection() { open_.pop_back(); }

void MarkdownVisitor::beginAlternative(bool, const std::string& condition) {
  here().condition = condition;
}

void MarkdownVisitor::endAlternative() { here().condition.clear(); }

}  // namespace palpate::keys
