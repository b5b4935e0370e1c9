// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_bytes.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "palpate/base/error.h"

namespace palpate::formats {
namespace {

[[noreturn]] void failToWrite(const std::string& file, int error) {
  throw std::runtime_error(file + ": cannot be written: " + std::strerror(error));
}

/// Opens a new file beside `file`; `name` receives its name.
int openBeside(const std::string& file, std::string* name) {
  for (int attempt = 0;; ++attempt) {
    *name = file + ".part" + std::to_string(::getpid()) + "-" + std::to_string(attempt);
    const int descriptor = ::open(name->c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) return descriptor;
    if (errno != EEXIST || attempt == 1000) failToWrite(file, errno);
  }
}

bool writeAll(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(descriptor, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

}  // namespace

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

void writeFileAtomically(const std::string& file, std::string_view bytes) {
  std::string part;
  const int descriptor = openBeside(file, &part);
  int error = writeAll(descriptor, bytes) ? 0 : errno;
  if (::close(descriptor) != 0 && error == 0) error = errno;
  if (error == 0 && std::rename(part.c_str(), file.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(part.c_str());
    failToWrite(file, error);
  }
}

std::string lowerCaseExtension(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return extension;
}

}  // namespace palpate::formats
