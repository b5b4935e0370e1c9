// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace palpate::formats {

/// Gives bytes from memory or from base64 text, as many at a time as wanted. Base64 with padding
/// in the middle (one encoding after the other) reads on behind it.
class ByteStream {
 public:
  ByteStream(std::string_view text, bool base64) : text_(text), base64_(base64) {}

  /// The next `size` bytes; fewer where the text ends or is no base64.
  std::string read(std::size_t size);
  /// An upper bound of the bytes that are left.
  std::size_t room() const { return text_.size() - position_ + pending_.size(); }

 private:
  bool decodeGroup();

  std::string_view text_;
  bool base64_;
  std::size_t position_ = 0;
  std::string pending_;  // decoded, not read yet
};

}  // namespace palpate::formats
