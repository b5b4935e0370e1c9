// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/scene/scene.h"

namespace palpate::cli {

/// Which organ of the scene `--organ` means; a scene of one organ needs no name.
/// @throws InputError
inline std::size_t organIndex(const scene::Scene& scene, const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scene.organs.size(); ++i) {
    if (scene.organs[i].name == name) return i;
    names.push_back(scene.organs[i].name);
  }
  if (name.empty() && names.size() == 1) return 0;
  throw InputError("command line", "--organ", name, "must be one of " + joinNames(names));
}

}  // namespace palpate::cli
