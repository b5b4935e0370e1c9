// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace palpate::formats {

/// Reads bytes from memory or base64 text in pieces. Continues after padding in the middle, for
/// concatenated base64 encodings.
class ByteStream {
 public:
  ByteStream(std::string_view text, bool base64) : text_(text), base64_(base64) {}

  /// The next `size` bytes; fewer at the end of the text or at invalid base64.
  std::string read(std::size_t size);
  /// Upper bound of the remaining bytes.
  std::size_t room() const { return text_.size() - position_ + pending_.size(); }

 private:
  bool decodeGroup();

  std::string_view text_;
  bool base64_;
  std::size_t position_ = 0;
  std::string pending_;  // decoded but not yet read
};

}  // namespace palpate::formats
