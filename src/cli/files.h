// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "palpate/base/error.h"

namespace palpate::cli {

/// Makes the folder if it is not there.
/// @throws InputError
inline std::filesystem::path makeFolder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw InputError(folder, "", "", "cannot be made a folder: " + error.message());
  return folder;
}

}  // namespace palpate::cli
