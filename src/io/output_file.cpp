// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/io/output_file.h"

#include <cerrno>
#include <cstring>

#include "palpate/base/error.h"

namespace palpate::io {

OutputFile::OutputFile(const std::string& file) : file_(file) {
  errno = 0;
  stream_.open(file, std::ios::binary | std::ios::trunc);
  if (!stream_) fail();
}

void OutputFile::write(const std::string& bytes) {
  errno = 0;
  if (!stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()))) fail();
}

void OutputFile::flush() {
  errno = 0;
  if (!stream_.flush()) fail();
}

void OutputFile::close() {
  errno = 0;
  stream_.close();
  if (!stream_) fail();
}

void OutputFile::fail() const {
  const std::string reason = errno == 0 ? "" : std::string(": ") + std::strerror(errno);
  throw InputError(file_, "", "", "cannot be written" + reason);
}

}  // namespace palpate::io
