// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_bytes.h"

#include <algorithm>
#include <filesystem>

#include "palpate/base/error.h"
#include "palpate/base/text_file.h"

namespace palpate::formats {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 31;

}  // namespace

std::string readFileBytes(const std::string& file) {
  std::string bytes = readTextFile(file, kMaxBytes);
  if (bytes.empty()) throw InputError(file, "", "", "the file is empty");
  return bytes;
}

std::string lowerCase(std::string_view word) {
  std::string text(word);
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

std::string lowerCaseExtension(const std::string& file) {
  return lowerCase(std::filesystem::path(file).extension().string());
}

}  // namespace palpate::formats
