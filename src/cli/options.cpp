// SPDX-License-Identifier: GPL-3.0-or-later
#include "options.h"

#include <unistd.h>  // access: POSIX

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "palpate/base/error.h"
#include "palpate/base/number.h"

namespace palpate::cli {

void requirePositive(const std::string& option, double value) {
  if (std::isfinite(value) && value > 0.0) return;
  throw InputError("command line", option, formatNumber(value), "must be a number > 0");
}

void requireNotNegative(const std::string& option, double value) {
  if (std::isfinite(value) && value >= 0.0) return;
  throw InputError("command line", option, formatNumber(value), "must be a number >= 0");
}

void requireWritable(const std::string& option, const std::string& file,
                     const std::vector<std::string>& extensions) {
  const std::filesystem::path path(file);
  if (!std::count(extensions.begin(), extensions.end(), path.extension().string())) {
    throw InputError("command line", option, file, "must end in " + joinNames(extensions));
  }
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (!std::filesystem::is_directory(folder)) {
    throw InputError("command line", option, file, "must be in a folder that exists");
  }
  if (access(folder.c_str(), W_OK) != 0 || std::filesystem::is_directory(path)) {
    throw InputError("command line", option, file, "cannot be written");
  }
}

}  // namespace palpate::cli
