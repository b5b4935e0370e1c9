// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <stdexcept>
#include <string>
#include <string_view>

#include "support/temp_folder.h"

namespace palpate::fuzz {

/// A file for readers that want a path. It goes away with the object. scripts/checks/fuzz.sh has
/// temporary files lie in memory.
class ScratchFile {
 public:
  explicit ScratchFile(const std::string& name) : path_(folder_.path(name)) {}

  /// Writes the bytes in the place of what was there, and returns the file's path.
  const std::string& write(std::string_view bytes) const {
    const int file = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const bool whole = file >= 0 && ::write(file, bytes.data(), bytes.size()) ==
                                        static_cast<ssize_t>(bytes.size());
    if (file >= 0) ::close(file);
    if (!whole) throw std::runtime_error("cannot write " + path_);
    return path_;
  }
  const std::string& path() const { return path_; }
  const test::TempFolder& folder() const { return folder_; }

 private:
  test::TempFolder folder_;
  std::string path_;
};

}  // namespace palpate::fuzz
