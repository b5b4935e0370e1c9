// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fstream>
#include <string>

namespace palpate::io {

/// A file to be written, with errors of all writes (full disk, no permission) reported. All
/// functions throw InputError naming the file.
class OutputFile {
 public:
  explicit OutputFile(const std::string& file);

  void write(const std::string& bytes);
  void flush();
  void close();

 private:
  [[noreturn]] void fail() const;

  std::string file_;
  std::ofstream stream_;
};

}  // namespace palpate::io
