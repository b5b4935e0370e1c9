// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/sim/simulator.h"

namespace palpate::node {

/// Adds `<name>/` to the tf_prefix of each instrument with joint input that has a frame in common
/// with another instrument or with the world. Frames of an instrument with tf input stay: another
/// program names them. Returns the names of the instruments whose frames remain ambiguous.
/// An instrument whose URDF cannot be read counts as one without frames.
std::vector<std::string> separateFrames(scene::Scene* scene);

/// The URDF of instrument `i` with links named as their frames in tf. Of an instrument with tf
/// input only the links that TfLookup needs: the others need not be in tf.
/// @throws InputError
std::string robotDescription(const sim::Simulator& simulator, int i);

/// The frame of the root link of instrument `i`.
std::string rootFrame(const sim::Simulator& simulator, int i);

}  // namespace palpate::node
