// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace palpate::formats {

/// How words are cut in a text format.
struct Syntax {
  char comment = '\0';           ///< From here to the end of the line is blank; '\0': no comments.
  bool comma_is_blank = false;   ///< As in VRML.
  std::string_view punctuation;  ///< Characters that are words by themselves.
  bool strings = false;          ///< "..." is one word, with its quotes.
};

/// Walks through a file, by words or by bytes, and knows where it is when something is wrong.
/// All failures are InputErrors that name the line (in text) or the byte (in binary data).
class Cursor {
 public:
  /// `bytes` must outlive the cursor. `file` is for messages.
  Cursor(std::string file, std::string_view bytes, Syntax syntax = Syntax());

  const std::string& file() const { return file_; }
  std::size_t position() const { return position_; }
  std::size_t remaining() const { return bytes_.size() - position_; }
  bool atEnd();  ///< Nothing but blanks follows.

  std::string_view word();        ///< The next word; "" at the end of the file.
  std::string_view wordOnLine();  ///< The next word of this line; "" at the end of the line.
  std::string_view peek();        ///< The next word, again next time.
  std::string_view restOfLine();  ///< Without the line's end, which is passed.
  void skipLine() { restOfLine(); }
  /// Passes everything up to and including `text`.
  void skipPast(std::string_view text);

  /// `what` says what is expected here: "x of vertex 3".
  double number(const char* what) { return toNumber(word(), what); }
  std::int64_t integer(const char* what) { return toInteger(word(), what); }
  /// One that an int holds: a tag, an entity.
  int smallInteger(const char* what);
  void expect(std::string_view word);
  /// A number of things that follow, each of at least `bytes_each` bytes: refused before anything
  /// is allocated if they cannot all be there, or are more than int can count.
  std::size_t count(const char* what, std::size_t bytes_each);
  void checkCount(std::int64_t count, const char* what, std::size_t bytes_each);

  /// Finite; the whole word.
  double toNumber(std::string_view word, const char* what);
  std::int64_t toInteger(std::string_view word, const char* what);

  /// The next `size` bytes as they are.
  std::string_view bytes(std::size_t size, const char* what);

  /// Of the last word or bytes read: "line 12" or "byte 345".
  std::string where() const;
  std::ptrdiff_t line() const;  ///< From 1 on.
  [[noreturn]] void fail(std::string_view value, const std::string& allowed) const;

 private:
  bool isBlank(char c) const;
  void skipBlanks(bool across_lines);
  std::string_view cutWord();

  std::string file_;
  std::string_view bytes_;
  Syntax syntax_;
  std::size_t position_ = 0;
  std::size_t last_ = 0;                // start of what was read last
  bool binary_ = false;                 // was read by bytes()
  mutable std::size_t counted_to_ = 0;  // lines are counted on from where they were counted last
  mutable std::ptrdiff_t line_ = 1;     // the one that counted_to_ is in
};

}  // namespace palpate::formats
