// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace palpate {

/// Replaces a file atomically: readers see the old or the new content, never a part, also after a
/// crash.
///
///     AtomicFile file("state.csv");
///     std::ofstream out(file.part());   // any writer that takes a name
///     ...                               // and has closed it:
///     file.commit();
class AtomicFile {
 public:
  /// Makes an empty file next to `file`, with a name unique among writers of all processes. A link
  /// is followed. @throws InputError naming `file` on failure, or if `file` is not a regular file.
  explicit AtomicFile(const std::string& file);
  /// Removes the part unless commit() was called; the old file stays.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::string& part() const { return part_; }

  /// Syncs the part to the disk and renames it to the file's name.
  /// @throws InputError on failure; the old file stays.
  void commit();

 private:
  std::string file_;
  std::string part_;
};

/// Writes a whole file atomically. @throws InputError on failure; the old file stays.
void writeFileAtomically(const std::string& file, std::string_view bytes);

}  // namespace palpate
