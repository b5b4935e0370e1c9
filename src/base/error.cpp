// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/error.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace palpate {
namespace {

std::string describe(const std::string& file, const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& p : problems) {
    if (!text.empty()) text += '\n';
    text += file;
    if (!p.key.empty()) text += ": " + p.key;
    if (!p.value.empty()) text += " = " + p.value;
    text += ": " + p.allowed;
  }
  return text;
}

std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row.back();
}

}  // namespace

InputError::InputError(std::string file, std::vector<Problem> problems)
    : std::runtime_error(describe(file, problems)),
      file_(std::move(file)),
      problems_(std::move(problems)) {}

InputError::InputError(std::string file, std::string key, std::string value, std::string allowed)
    : InputError(std::move(file),
                 std::vector<Problem>{{std::move(key), std::move(value), std::move(allowed)}}) {}

std::string nearestName(const std::string& name, const std::vector<std::string>& known) {
  std::string nearest;
  std::size_t best = std::max<std::size_t>(2, name.size() / 3) + 1;
  for (const std::string& candidate : known) {
    const std::size_t distance = editDistance(name, candidate);
    if (distance < best) {
      best = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string joinNames(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace palpate
