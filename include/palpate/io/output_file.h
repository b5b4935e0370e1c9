// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fstream>
#include <string>

namespace palpate::io {

/// A file that is written anew and that does not lose a failed write (full disk, no permission).
/// All functions throw InputError naming the file.
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
