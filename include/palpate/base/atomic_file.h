// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace palpate {

/// A file that appears under its name only when it is whole: readers, and who looks after a crash,
/// find the old one or the new one and never a part.
///
///     AtomicFile file("state.csv");
///     std::ofstream out(file.part());   // any writer that takes a name
///     ...                               // and has closed it:
///     file.commit();
class AtomicFile {
 public:
  /// Makes an empty file beside `file` with a name that no other writer has, in this process or
  /// another. Behind a link the file that it points to is meant.
  /// @throws InputError naming `file` if that cannot be done, or if there is something under its
  /// name that is no regular file.
  explicit AtomicFile(const std::string& file);
  /// Without commit() the part is removed and what was there before stays.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::string& part() const { return part_; }

  /// Makes sure that the part is on the disk and gives it its name.
  /// @throws InputError if that fails; what was there before stays.
  void commit();

 private:
  std::string file_;
  std::string part_;
};

/// All of a file at once.
/// @throws InputError if it cannot be written; what was there before stays, and no part of the new.
void writeFileAtomically(const std::string& file, std::string_view bytes);

}  // namespace palpate
