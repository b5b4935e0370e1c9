// SPDX-License-Identifier: GPL-3.0-or-later
#include "cursor.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/number.h"

namespace palpate::formats {
namespace {

/// A word shortened and made printable for messages.
std::string shown(std::string_view word) {
  std::string text(word.substr(0, 40));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return word.size() > 40 ? text + "..." : text;
}

}  // namespace

Cursor::Cursor(std::string file, std::string_view bytes, Syntax syntax)
    : file_(std::move(file)), bytes_(bytes), syntax_(syntax) {}

bool Cursor::isBlank(char c) const {
  return c == ' ' || (c >= '\t' && c <= '\r') || (c == ',' && syntax_.comma_is_blank);
}

void Cursor::skipBlanks(bool across_lines) {
  while (position_ < bytes_.size()) {
    const char c = bytes_[position_];
    if (syntax_.comment != '\0' && c == syntax_.comment) {
      position_ = std::min(bytes_.find('\n', position_), bytes_.size());
    } else if (isBlank(c) && (across_lines || c != '\n')) {
      ++position_;
    } else {
      return;
    }
  }
}

std::string_view Cursor::cutWord() {
  binary_ = false;
  last_ = position_;
  const auto is_punctuation = [&](char c) {
    return syntax_.punctuation.find(c) != std::string_view::npos;
  };
  if (position_ == bytes_.size()) return {};
  if (is_punctuation(bytes_[position_])) return bytes_.substr(position_++, 1);
  if (syntax_.strings && bytes_[position_] == '"') {
    for (++position_; position_ < bytes_.size() && bytes_[position_] != '"'; ++position_) {
      if (bytes_[position_] == '\\') ++position_;
    }
    if (position_ >= bytes_.size()) {
      position_ = bytes_.size();
      fail("", "a string that has no end");
    }
    ++position_;
    return bytes_.substr(last_, position_ - last_);
  }
  while (position_ < bytes_.size() && !isBlank(bytes_[position_]) &&
         !is_punctuation(bytes_[position_]) &&
         (syntax_.comment == '\0' || bytes_[position_] != syntax_.comment)) {
    ++position_;
  }
  return bytes_.substr(last_, position_ - last_);
}

bool Cursor::atEnd() {
  skipBlanks(true);
  return position_ == bytes_.size();
}

std::string_view Cursor::word() {
  skipBlanks(true);
  return cutWord();
}

std::string_view Cursor::wordOnLine() {
  skipBlanks(false);
  if (position_ < bytes_.size() && bytes_[position_] == '\n') return {};
  return cutWord();
}

std::string_view Cursor::peek() {
  const std::size_t position = position_, last = last_;
  const bool binary = binary_;
  const std::string_view next = word();
  position_ = position;
  last_ = last;
  binary_ = binary;
  return next;
}

std::string_view Cursor::restOfLine() {
  binary_ = false;
  last_ = position_;
  const std::size_t end = std::min(bytes_.find('\n', position_), bytes_.size());
  std::string_view line = bytes_.substr(position_, end - position_);
  position_ = std::min(end + 1, bytes_.size());
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

void Cursor::skipPast(std::string_view text) {
  const std::size_t found = bytes_.find(text, position_);
  if (found == std::string_view::npos) {
    fail("", "truncated: '" + std::string(text) + "' must follow");
  }
  position_ = found + text.size();
}

double Cursor::toNumber(std::string_view word, const char* what) {
  const std::optional<double> value = parseAnyNumber(word);
  if (value && std::isfinite(*value)) return *value;
  if (word.empty()) fail("", std::string("ends where a number is expected: ") + what);
  if (value) fail(word, std::string("must be finite: ") + what);
  fail(word, std::string("must be a number: ") + what);
}

std::int64_t Cursor::toInteger(std::string_view word, const char* what) {
  std::int64_t value = 0;
  const char* end = word.data() + word.size();
  const auto result = std::from_chars(word.data(), end, value);
  if (!word.empty() && result.ec == std::errc() && result.ptr == end) return value;
  if (word.empty()) fail("", std::string("ends where a whole number is expected: ") + what);
  fail(word, std::string("must be a whole number: ") + what);
}

int Cursor::smallInteger(const char* what) {
  const std::int64_t value = integer(what);
  if (value == static_cast<int>(value)) return static_cast<int>(value);
  fail(std::to_string(value), std::string("is too large: ") + what);
}

void Cursor::expect(std::string_view expected) {
  const std::string_view found = word();
  if (found == expected) return;
  fail(found, (found.empty() ? "truncated: '" : "must be '") + std::string(expected) +
                  (found.empty() ? "' must follow" : "'"));
}

std::size_t Cursor::count(const char* what, std::size_t bytes_each) {
  const std::int64_t n = integer(what);
  checkCount(n, what, bytes_each);
  return static_cast<std::size_t>(n);
}

void Cursor::checkCount(std::int64_t count, const char* what, std::size_t bytes_each) {
  const std::string value = std::to_string(count);
  if (count < 0) fail(value, std::string("must not be negative: ") + what);
  // Text has one separator fewer than items, hence + 1.
  const std::size_t room = remaining() / bytes_each + 1;
  if (static_cast<std::uint64_t>(count) > room || count > std::numeric_limits<int>::max() / 16) {
    fail(value, std::string("truncated or wrong ") + what + ": only " +
                    std::to_string(remaining()) + " bytes follow");
  }
}

std::string_view Cursor::bytes(std::size_t size, const char* what) {
  binary_ = true;
  last_ = position_;
  if (size > remaining()) {
    fail("", std::string("truncated: ") + what + " takes " + std::to_string(size) +
                 " bytes, there are " + std::to_string(remaining()));
  }
  position_ += size;
  return bytes_.substr(last_, size);
}

std::ptrdiff_t Cursor::line() const {
  if (last_ < counted_to_) {
    counted_to_ = 0;
    line_ = 1;
  }
  const auto begin = bytes_.begin();
  line_ +=
      std::count(begin + static_cast<long>(counted_to_), begin + static_cast<long>(last_), '\n');
  counted_to_ = last_;
  return line_;
}

std::string Cursor::where() const {
  return binary_ ? "byte " + std::to_string(last_) : "line " + std::to_string(line());
}

void Cursor::fail(std::string_view value, const std::string& allowed) const {
  throw InputError(file_, where(), shown(value), allowed);
}

}  // namespace palpate::formats
