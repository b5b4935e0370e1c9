// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/text_file.h"

#include <filesystem>
#include <fstream>
#include <system_error>

#include "palpate/base/error.h"

namespace palpate {

std::string readTextFile(const std::string& file, std::size_t max_bytes) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) throw InputError(file, "", "", "no such file");
  if (fs::is_directory(status)) throw InputError(file, "", "", "is a folder, not a file");

  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file, "", "", "cannot be opened for reading");
  std::string text;
  char block[1 << 16];
  while (stream.read(block, sizeof(block)) || stream.gcount() > 0) {
    text.append(block, static_cast<std::size_t>(stream.gcount()));
    if (text.size() > max_bytes) {
      throw InputError(file, "", "",
                       "is larger than " + std::to_string(max_bytes >> 20) +
                           " MiB, more than any file of this kind");
    }
  }
  if (stream.bad()) throw InputError(file, "", "", "cannot be read to its end");
  return text;
}

}  // namespace palpate
