// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace palpate::formats {

/// Word syntax of a text format.
struct Syntax {
  char comment = '\0';           ///< Begins a comment up to the end of the line; '\0': none.
  bool comma_is_blank = false;   ///< As in VRML.
  std::string_view punctuation;  ///< Characters that are words of their own.
  bool strings = false;          ///< "..." is one word, with its quotes.
};

/// Reads a file by words or bytes and keeps the position for errors. All failures are InputErrors
/// with the line (text) or byte (binary data).
class Cursor {
 public:
  /// @pre `bytes` outlives the cursor. `file` is for messages.
  Cursor(std::string file, std::string_view bytes, Syntax syntax = Syntax());

  const std::string& file() const { return file_; }
  std::size_t position() const { return position_; }
  std::size_t remaining() const { return bytes_.size() - position_; }
  bool atEnd();  ///< Whether only blanks follow.

  std::string_view word();        ///< The next word; "" at the end of the file.
  std::string_view wordOnLine();  ///< The next word of this line; "" at the end of the line.
  std::string_view peek();        ///< The next word, without consuming it.
  std::string_view restOfLine();  ///< Consumes the line's end, but omits it.
  void skipLine() { restOfLine(); }
  /// Skips everything up to and including `text`.
  void skipPast(std::string_view text);

  /// `what` names the expected item: "x of vertex 3".
  double number(const char* what) { return toNumber(word(), what); }
  std::int64_t integer(const char* what) { return toInteger(word(), what); }
  /// An integer in the range of int, for example a tag.
  int smallInteger(const char* what);
  void expect(std::string_view word);
  /// Number of following items of at least `bytes_each` bytes. Refused, before any allocation, if
  /// the remaining file is too short or int too small.
  std::size_t count(const char* what, std::size_t bytes_each);
  void checkCount(std::int64_t count, const char* what, std::size_t bytes_each);

  /// Number of the whole word; must be finite.
  double toNumber(std::string_view word, const char* what);
  std::int64_t toInteger(std::string_view word, const char* what);

  /// The next `size` bytes unchanged.
  std::string_view bytes(std::size_t size, const char* what);

  /// Position of the last word or bytes: "line 12" or "byte 345".
  std::string where() const;
  std::ptrdiff_t line() const;  ///< Counted from 1.
  [[noreturn]] void fail(std::string_view value, const std::string& allowed) const;

 private:
  bool isBlank(char c) const;
  void skipBlanks(bool across_lines);
  std::string_view cutWord();

  std::string file_;
  std::string_view bytes_;
  Syntax syntax_;
  std::size_t position_ = 0;
  std::size_t last_ = 0;                // begin of the last word or bytes
  bool binary_ = false;                 // last read by bytes()
  mutable std::size_t counted_to_ = 0;  // position up to which lines are counted
  mutable std::ptrdiff_t line_ = 1;     // line at counted_to_
};

}  // namespace palpate::formats
