// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/material/own_constants.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "palpate/base/error.h"
#include "palpate/base/number.h"

namespace palpate::material {
namespace {

std::string listText(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + formatNumber(value);
  return text;
}

[[noreturn]] void refuse(const std::string& what, const std::string& value,
                         const std::string& allowed) {
  throw ConstantError(what, value, "must be " + allowed);
}

bool allFinite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

// The single number `name`, if `right` accepts it.
template <class Right>
double scalar(const Constants& constants, const std::string& name, const std::string& allowed,
              Right&& right) {
  const auto found = constants.find(name);
  if (found == constants.end()) refuse(name, "", allowed);
  const std::vector<double>& value = found->second;
  if (value.size() == 1 && std::isfinite(value[0]) && right(value[0])) return value[0];
  refuse(name, listText(value), allowed);
}

}  // namespace

std::vector<std::string> withBulkModulus(std::vector<std::string> names) {
  names.emplace_back("kappa");
  names.emplace_back("poisson_ratio");
  return names;
}

OwnConstants::OwnConstants(const Constants& constants, const std::vector<std::string>& needed)
    : constants_(constants) {
  const bool all = std::all_of(needed.begin(), needed.end(),
                               [&](const std::string& name) { return constants.count(name) > 0; });
  if (all && constants.count("kappa") + constants.count("poisson_ratio") == 1) return;
  throw std::invalid_argument("needs " + joinNames(needed) +
                              ", and either kappa [Pa] or poisson_ratio");
}

double OwnConstants::number(const std::string& name) const {
  return scalar(constants_, name, "one number, finite", [](double) { return true; });
}

double OwnConstants::positive(const std::string& name) const {
  return scalar(constants_, name, "one number > 0, finite", [](double x) { return x > 0.0; });
}

double OwnConstants::notNegative(const std::string& name) const {
  return scalar(constants_, name, "one number >= 0, finite", [](double x) { return x >= 0.0; });
}

double OwnConstants::numberOr(const std::string& name, double default_value) const {
  return constants_.count(name) ? number(name) : default_value;
}

std::vector<std::vector<double>> OwnConstants::listsOfEqualLength(
    const std::vector<std::string>& names) const {
  std::vector<std::vector<double>> lists;
  for (const std::string& name : names) {
    const std::vector<double>& list = constants_.at(name);
    if (list.empty() || !allFinite(list)) {
      refuse(name, listText(list), "one number or more, finite");
    }
    if (!lists.empty() && list.size() != lists[0].size()) {
      refuse(name, listText(list),
             "as many numbers as " + names[0] + " has, " + std::to_string(lists[0].size()));
    }
    lists.push_back(list);
  }
  return lists;
}

double OwnConstants::bulkModulus(double mu) const {
  if (constants_.count("kappa")) return positive("kappa");
  const double nu = scalar(constants_, "poisson_ratio", "one number in (-1, 0.5)",
                           [](double x) { return x > -1.0 && x < 0.5; });
  return moduliFromYoung(2.0 * mu * (1.0 + nu), nu).kappa;
}

void require(bool right, const std::string& what, double value, const std::string& allowed) {
  if (!right) refuse(what, formatNumber(value), allowed);
}

}  // namespace palpate::material
