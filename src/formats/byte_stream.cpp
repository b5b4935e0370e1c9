// SPDX-License-Identifier: GPL-3.0-or-later
#include "byte_stream.h"

#include <algorithm>

namespace palpate::formats {
namespace {

/// Value of a base64 digit [RFC 4648, table 1]; -1 for other characters.
int digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  return c == '/' ? 63 : -1;
}

bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

/// Decodes four characters to one, two or three bytes.
bool ByteStream::decodeGroup() {
  unsigned bits = 0;
  int num_digits = 0, num_characters = 0;
  while (num_characters < 4) {
    if (position_ == text_.size()) return false;
    const char c = text_[position_++];
    if (isBlank(c)) continue;
    ++num_characters;
    bits <<= 6;
    if (c == '=' && num_characters > 2) continue;
    const int value = digit(c);
    if (value < 0 || num_digits != num_characters - 1) return false;
    bits |= static_cast<unsigned>(value);
    ++num_digits;
  }
  for (int i = 0; i < num_digits - 1; ++i) {
    pending_.push_back(static_cast<char>(bits >> (16 - 8 * i) & 0xFF));
  }
  return true;
}

std::string ByteStream::read(std::size_t size) {
  if (!base64_) {
    const std::string bytes(text_.substr(position_, size));
    position_ += bytes.size();
    return bytes;
  }
  std::string bytes;
  bytes.reserve(std::min(size, room()));
  while (bytes.size() < size) {
    if (pending_.empty() && !decodeGroup()) break;
    const std::size_t n = std::min(size - bytes.size(), pending_.size());
    bytes.append(pending_, 0, n);
    pending_.erase(0, n);
  }
  return bytes;
}

}  // namespace palpate::formats
