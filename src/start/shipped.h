// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace palpate::start {

/// The folder whose `config` has the shipped scenes, organs and instruments: that of the
/// environment variable PALPATE_SHARE; else `share/palpate` one or two folders above that of the
/// program, where an installation has it; else the sources that the program was built from.
/// @throws InputError: PALPATE_SHARE has no config/scenes, or none of the others has.
std::string shareFolder();

/// Names of the shipped scenes, sorted.
/// @throws InputError as shareFolder().
std::vector<std::string> shippedScenes();

/// The file that a user means by `scene`: a file that is there, or package://NAME/rest, or the name
/// of a shipped scene. What has a "/" or a "." is a file, whether it is there or not.
/// @throws InputError: no file and no shipped scene, naming the nearest and all; no such package.
std::string sceneFile(const std::string& scene);

/// The trajectory that comes with the scene of this file: config/trajectories/NAME.csv, or the only
/// one whose name has the same first word, up to the first "_". "" if the file is no shipped scene,
/// or there is none.
std::string shippedTrajectory(const std::string& scene_file);

}  // namespace palpate::start
