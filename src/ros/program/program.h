// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "program_help.h"

namespace palpate::node {

inline constexpr int kBadInput = 2;  ///< Exit status after an InputError.

/// The main() of a program of the node: `--help` and the wait for the master, then ROS with the
/// threads that send at real-time priority where the system allows it, every signal and shutdown an
/// Ending, the node's last words sent. `run(sends_realtime)` returns the exit status; an InputError
/// in it is status 2, what else it throws 1, each said. The ROS graph is left within a second, or
/// not at all. `name`: of the node, unless it is remapped.
int runProgram(int argc, char** argv, const char* name, const About& about,
               const std::function<int(bool sends_realtime)>& run);

}  // namespace palpate::node
