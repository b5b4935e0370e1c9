// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/error.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace palpate {
namespace {

// Limits of messages [bytes]: terminals show them and obey control characters.
constexpr std::size_t kLongestValue = 200, kLongestText = 4000;
constexpr std::size_t kLongestName = 100;  // limit of names for nearestName() [bytes]

/// `text` without control characters, also two-byte ones of UTF-8, cut to `longest` bytes.
std::string readable(std::string text, std::size_t longest, bool keep_lines) {
  if (text.size() > longest) text = text.substr(0, longest) + "...";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const bool line = c == '\n' && keep_lines;
    if ((c < ' ' && !line) || c == 0x7F) text[i] = '?';
    if (c == 0xC2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xA0) {
      text[i] = text[i + 1] = '?';
    }
  }
  return text;
}

std::vector<Problem> readable(std::vector<Problem> problems) {
  for (Problem& p : problems) {
    p.key = readable(std::move(p.key), kLongestValue, false);
    p.value = readable(std::move(p.value), kLongestValue, false);
    p.allowed = readable(std::move(p.allowed), kLongestText, true);
  }
  return problems;
}

std::string describe(const std::string& file, const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& p : problems) {
    if (!text.empty()) text += '\n';
    text += readable(file, kLongestText, false);
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
    : InputError(Readable{std::move(file), readable(std::move(problems))}) {}

InputError::InputError(Readable what)
    : std::runtime_error(describe(what.file, what.problems)),
      file_(std::move(what.file)),
      problems_(std::move(what.problems)) {}

InputError::InputError(std::string file, std::string key, std::string value, std::string allowed)
    : InputError(std::move(file),
                 std::vector<Problem>{{std::move(key), std::move(value), std::move(allowed)}}) {}

std::string nearestName(const std::string& name, const std::vector<std::string>& known) {
  std::string nearest;
  if (name.size() > kLongestName) return nearest;
  std::size_t best = std::max<std::size_t>(2, name.size() / 3) + 1;
  for (const std::string& candidate : known) {
    if (candidate.size() >= name.size() + best) continue;
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
