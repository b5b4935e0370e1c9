// SPDX-License-Identifier: GPL-3.0-or-later
#include "value_visitor.h"

#include <algorithm>
#include <utility>

#include "palpate/base/number.h"

namespace palpate::keys {
namespace {

std::string valueText(double value) { return formatNumber(value); }
std::string valueText(int value) { return std::to_string(value); }
std::string valueText(const std::optional<double>& value) {
  return value ? formatNumber(*value) : "null";
}

// Text like "[1, 2, 3]".
template <class Numbers>
std::string valuesText(const Numbers& numbers) {
  std::string text;
  for (const auto& number : numbers) text += (text.empty() ? "" : ", ") + valueText(number);
  return "[" + text + "]";
}

std::string pointText(const Vec3& v) { return valuesText(std::array<double, 3>{v[0], v[1], v[2]}); }

}  // namespace

std::vector<KeyValue> fieldValues(const std::function<void(FieldVisitor&)>& fields) {
  ValueVisitor visitor;
  fields(visitor);
  return visitor.take();
}

bool ValueVisitor::hidden() const { return std::count(shown_.begin(), shown_.end(), false) > 0; }

bool ValueVisitor::add(const Field& field, const std::string& value, bool given, bool is_text) {
  if (hidden()) return false;
  values_.push_back({(open_.empty() ? "" : open_.back()) + field.key, value, is_text});
  return given;
}

bool ValueVisitor::number(const Field& field, double& value, const Range&) {
  return add(field, valueText(value));
}

bool ValueVisitor::integer(const Field& field, int& value, const Range&) {
  return add(field, valueText(value));
}

bool ValueVisitor::flag(const Field& field, bool& value) {
  return add(field, value ? "true" : "false");
}

bool ValueVisitor::text(const Field& field, std::string& value) {
  return add(field, value, !value.empty(), true);
}

bool ValueVisitor::name(const Field& field, std::string& value) {
  return add(field, value, !value.empty());
}

bool ValueVisitor::choice(const Field& field, std::string& value, const std::vector<std::string>&) {
  return add(field, value, !value.empty());
}

bool ValueVisitor::vector3(const Field& field, Vec3& value, const Range&) {
  return add(field, pointText(value));
}

bool ValueVisitor::vectors3(const Field& field, std::vector<Vec3>& values, const Range&, int) {
  std::string text;
  for (const Vec3& v : values) text += (text.empty() ? "" : ", ") + pointText(v);
  return add(field, "[" + text + "]", !values.empty());
}

bool ValueVisitor::integers3(const Field& field, Eigen::Vector3i& value, const Range&) {
  return add(field, valuesText(std::array<int, 3>{value[0], value[1], value[2]}));
}

bool ValueVisitor::partialVector3(const Field& field, PartialVec3& value, const Range&) {
  return add(field, valuesText(value));
}

// Reads nothing, so that rules are not checked again.
bool ValueVisitor::numbersOfKind(const std::string&, const std::vector<Kind>&, const std::string&,
                                 NumberLists& values) {
  for (const auto& [key, numbers] : values) {
    add({key, "", ""}, numbers.size() == 1 ? valueText(numbers.front()) : valuesText(numbers));
  }
  return false;
}

void ValueVisitor::rule(bool, const std::string&, const std::string&) {}

void ValueVisitor::open(const std::string& key) {
  open_.push_back((open_.empty() ? "" : open_.back()) + key + ".");
}

FieldVisitor::Entered ValueVisitor::enterSection(const Field& field) {
  open(field.key);
  return {!hidden(), true};
}

FieldVisitor::Entered ValueVisitor::enterNumberOrSection(const Field& field, double&,
                                                         const Range&) {
  return enterSection(field);  // which contains the number
}

FieldVisitor::Items ValueVisitor::enterList(const Field&, int, int present) {
  return {present, false};
}

bool ValueVisitor::enterItem(const Field& field, int index) {
  open(field.key + "[" + std::to_string(index) + "]");
  return true;
}

void ValueVisitor::leaveSection() { open_.pop_back(); }
void ValueVisitor::beginAlternative(bool chosen, const std::string&) { shown_.push_back(chosen); }
void ValueVisitor::endAlternative() { shown_.pop_back(); }
void ValueVisitor::beginOptional(bool set) { shown_.push_back(set); }
void ValueVisitor::endOptional() { shown_.pop_back(); }

}  // namespace palpate::keys
