// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace palpate::sim::test {

/// Names of the scenes in config/scenes.
std::vector<std::string> shippedScenes();

/// The state hash after each row of the first part of such a scene's trajectory.
std::vector<std::uint64_t> hashesOf(const std::string& scene);

/// The same of the scene in `file`, with the trajectory of the shipped one.
std::vector<std::uint64_t> hashesOfFile(const std::string& file, const std::string& scene);

}  // namespace palpate::sim::test
