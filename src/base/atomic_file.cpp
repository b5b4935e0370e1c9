// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "palpate/base/error.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& file, const std::string& why) {
  throw InputError(file, "", "", "cannot be written: " + why);
}

std::string reason(int error) { return std::strerror(error); }

/// A file descriptor that closes on destruction.
class WriteDescriptor {
 public:
  WriteDescriptor(const std::string& file, int flags)
      : value_(::open(file.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~WriteDescriptor() { close(); }
  WriteDescriptor(const WriteDescriptor&) = delete;
  WriteDescriptor& operator=(const WriteDescriptor&) = delete;

  bool ok() const { return value_ >= 0; }
  bool write(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t n = ::write(value_, bytes.data(), bytes.size());
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(n));
    }
    return true;
  }
  /// Ignores file systems without fsync.
  bool sync() const { return ::fsync(value_) == 0 || errno == EINVAL || errno == ENOTSUP; }
  bool close() {
    const int value = value_;
    value_ = -1;
    return value < 0 || ::close(value) == 0;
  }

 private:
  int value_;
};

/// `file`, or the target of a link.
std::string behindLinks(const std::string& file) {
  std::error_code error;
  if (!fs::is_symlink(fs::symlink_status(file, error))) return file;
  const fs::path target = fs::weakly_canonical(file, error);
  if (error) fail(file, error.message());
  return target.string();
}

/// Makes a new empty file next to `file` and returns its name.
std::string makePart(const std::string& file) {
  for (int attempt = 0;; ++attempt) {
    const std::string part =
        file + ".part" + std::to_string(::getpid()) + "-" + std::to_string(attempt);
    if (WriteDescriptor(part, O_WRONLY | O_CREAT | O_EXCL).ok()) return part;
    if (errno != EEXIST || attempt == 1000) fail(file, reason(errno));
  }
}

}  // namespace

AtomicFile::AtomicFile(const std::string& file) : file_(behindLinks(file)) {
  std::error_code none;
  const fs::file_status status = fs::status(file_, none);
  if (fs::exists(status) && !fs::is_regular_file(status)) fail(file, "it is no regular file");
  part_ = makePart(file_);
}

AtomicFile::~AtomicFile() {
  if (!part_.empty()) ::unlink(part_.c_str());
}

void AtomicFile::commit() {
  WriteDescriptor descriptor(part_, O_RDONLY);
  if (!descriptor.ok() || !descriptor.sync()) fail(file_, reason(errno));
  if (std::rename(part_.c_str(), file_.c_str()) != 0) fail(file_, reason(errno));
  part_.clear();
}

void writeFileAtomically(const std::string& file, std::string_view bytes) {
  AtomicFile whole(file);
  WriteDescriptor out(whole.part(), O_WRONLY);
  if (!out.ok() || !out.write(bytes) || !out.close()) fail(file, reason(errno));
  whole.commit();
}

}  // namespace palpate
