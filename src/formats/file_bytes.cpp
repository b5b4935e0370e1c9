// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_bytes.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "palpate/base/error.h"

namespace palpate::formats {
std::string readFileBytes(const std::string& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw InputError(file, "", "", "no such file");
  if (!std::filesystem::is_regular_file(status)) {
    throw InputError(file, "", "", "must be a regular file");
  }
  std::ifstream in(file, std::ios::binary);
  const auto size = std::filesystem::file_size(file, error);
  std::string bytes(in && !error ? size : 0, '\0');
  if (!in || error || !in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
    throw InputError(file, "", "", "cannot be read");
  }
  if (bytes.empty()) throw InputError(file, "", "", "the file is empty");
  return bytes;
}

std::string lowerCaseExtension(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return extension;
}

}  // namespace palpate::formats
