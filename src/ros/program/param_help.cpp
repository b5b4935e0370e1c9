// SPDX-License-Identifier: GPL-3.0-or-later
#include "param_help.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include "palpate/base/error.h"
#include "palpate/base/number.h"

namespace palpate::node {

using keys::Field;
using keys::Range;

namespace {

template <class Numbers>
std::string listed(const Numbers& numbers) {
  std::vector<std::string> texts;
  for (const auto& x : numbers) texts.push_back(formatNumber(static_cast<double>(x)));
  return "[" + joinNames(texts) + "]";
}

std::string allowedText(const Range& range) {
  const std::string text = range.text();
  return text == Range::any().text() ? "" : text;
}

}  // namespace

std::string ParamHelp::table() const {
  std::size_t name_width = 0, value_width = 0;
  for (const Row& row : rows_) {
    name_width = std::max(name_width, row.name.size());
    // A long default has its line to itself.
    if (row.value.size() <= 24) value_width = std::max(value_width, row.value.size());
  }
  std::ostringstream out;
  for (const Row& row : rows_) {
    out << "  " << std::left << std::setw(static_cast<int>(name_width)) << row.name << "  ";
    if (row.value.size() > value_width) {
      out << row.value << '\n' << std::string(name_width + 4, ' ') << std::string(value_width, ' ');
    } else {
      out << std::setw(static_cast<int>(value_width)) << row.value;
    }
    out << "  " << row.meaning << '\n';
  }
  return out.str();
}

std::string ParamHelp::path(const std::string& key) const {
  std::string p = "~";
  for (const std::string& section : open_) p += section + "/";
  return p + key;
}

void ParamHelp::add(const Field& field, const std::string& value, const std::string& allowed) {
  std::string meaning = field.doc;
  if (!field.unit.empty()) meaning += " [" + field.unit + "]";
  if (!allowed.empty()) meaning += " (" + allowed + ")";
  rows_.push_back({path(field.key), value.empty() ? "\"\"" : value, meaning});
}

void ParamHelp::line(const std::string& name, const std::string& meaning) {
  rows_.push_back({path(name), "", meaning});
}

bool ParamHelp::number(const Field& field, double& value, const Range& range) {
  add(field, formatNumber(value), allowedText(range));
  return false;
}

bool ParamHelp::integer(const Field& field, int& value, const Range& range) {
  add(field, std::to_string(value), allowedText(range));
  return false;
}

bool ParamHelp::flag(const Field& field, bool& value) {
  add(field, value ? "true" : "false", "");
  return false;
}

bool ParamHelp::text(const Field& field, std::string& value) {
  add(field, value, "");
  return false;
}

bool ParamHelp::name(const Field& field, std::string& value) { return text(field, value); }

bool ParamHelp::choice(const Field& field, std::string& value,
                       const std::vector<std::string>& allowed) {
  add(field, value, joinNames(allowed));
  return false;
}

bool ParamHelp::texts(const Field& field, std::vector<std::string>& values) {
  add(field, "[" + joinNames(values) + "]", "");
  return false;
}

bool ParamHelp::numbers(const Field& field, std::vector<double>& values) {
  add(field, listed(values), "");
  return false;
}

bool ParamHelp::vector3(const Field& field, Vec3& value, const Range& range) {
  add(field, listed(std::vector<double>{value.x(), value.y(), value.z()}), allowedText(range));
  return false;
}

bool ParamHelp::integers3(const Field& field, Eigen::Vector3i& value, const Range& range) {
  add(field, listed(std::vector<int>{value.x(), value.y(), value.z()}), allowedText(range));
  return false;
}

// No parameter is one of these.
bool ParamHelp::vectors3(const Field&, std::vector<Vec3>&, const Range&, int) { return false; }
bool ParamHelp::partialVector3(const Field&, keys::PartialVec3&, const Range&) { return false; }
bool ParamHelp::numbersOfKind(const std::string&, const std::vector<keys::Kind>&,
                              const std::string&, keys::NumberLists&) {
  return false;
}
keys::FieldVisitor::Items ParamHelp::enterList(const Field&, int, int) { return {0, false}; }
bool ParamHelp::enterItem(const Field&, int) { return false; }

void ParamHelp::rule(bool holds, const std::string& key, const std::string&) {
  if (holds) return;
  for (Row& row : rows_) {
    if (row.name == path(key)) row.value = "required";
  }
}

keys::FieldVisitor::Entered ParamHelp::enterSection(const Field& field) {
  open_.push_back(field.key);
  return {false, true};
}

keys::FieldVisitor::Entered ParamHelp::enterNumberOrSection(const Field& field, double& value,
                                                            const Range& range) {
  number(field, value, range);
  return enterSection(field);
}

void ParamHelp::leaveSection() { open_.pop_back(); }
void ParamHelp::beginAlternative(bool, const std::string&) {}
void ParamHelp::endAlternative() {}

}  // namespace palpate::node
