// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/text_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "palpate/base/error.h"

namespace palpate {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;

/// An open file that closes on destruction.
class ReadDescriptor {
 public:
  // O_NONBLOCK: opening a pipe would wait for its writer.
  explicit ReadDescriptor(const std::string& file)
      : value_(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {}
  ~ReadDescriptor() {
    if (value_ >= 0) ::close(value_);
  }
  ReadDescriptor(const ReadDescriptor&) = delete;
  ReadDescriptor& operator=(const ReadDescriptor&) = delete;

  int value() const { return value_; }

 private:
  int value_;
};

[[noreturn]] void tooLarge(const std::string& file, std::size_t max_bytes) {
  throw InputError(file, "", "",
                   "is larger than " + std::to_string(max_bytes / kMiB) +
                       " MiB, more than any file of this kind");
}

/// Size of a regular file; others may have no end.
std::size_t sizeOf(const ReadDescriptor& descriptor, const std::string& file) {
  struct stat status {};
  if (::fstat(descriptor.value(), &status) != 0) {
    throw InputError(file, "", "", std::string("cannot be read: ") + std::strerror(errno));
  }
  if (S_ISDIR(status.st_mode))
    throw InputError(file, "", "", "is a folder, must be a regular file");
  if (!S_ISREG(status.st_mode)) throw InputError(file, "", "", "must be a regular file");
  return static_cast<std::size_t>(status.st_size);
}

}  // namespace

std::string readTextFile(const std::string& file, std::size_t max_bytes) {
  const ReadDescriptor descriptor(file);
  if (descriptor.value() < 0) {
    const bool none = errno == ENOENT || errno == ENOTDIR;
    throw InputError(file, "", "",
                     none ? "no such file"
                          : std::string("cannot be opened for reading: ") + std::strerror(errno));
  }
  const std::size_t size = sizeOf(descriptor, file);
  if (size > max_bytes) tooLarge(file, max_bytes);
  // One byte more detects a file that grew or misreports its size.
  std::string text(size + 1, '\0');
  std::size_t done = 0;
  for (;;) {
    const ssize_t n = ::read(descriptor.value(), &text[done], text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      throw InputError(file, "", "",
                       std::string("cannot be read to its end: ") + std::strerror(errno));
    }
    if (n == 0) break;
    done += static_cast<std::size_t>(n);
    if (done > max_bytes) tooLarge(file, max_bytes);
    if (done == text.size()) text.resize(std::min(2 * done, max_bytes + 1));
  }
  text.resize(done);
  return text;
}

}  // namespace palpate
