// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/sim/simulator_state.h"

namespace palpate::node {

/// The folder of ~state_directory; made when needed. The names of files in it come from the time
/// and from the node's name: whoever asks for a state has no part in them.
class StateFolder {
 public:
  /// `node`: its name in the ROS graph.
  StateFolder(std::string folder, const std::string& node);

  /// Writes a file of its own, whose name sorts by time, and returns its path.
  /// @throws std::exception that says what failed, also where the folder has very many already:
  /// who asks again and again shall not fill the disk.
  std::string add(const sim::SimulatorState& state) const;
  /// Writes the one file for where the node ended, over that of the last time.
  std::string keepLast(const sim::SimulatorState& state) const;

 private:
  std::string write(const std::string& name, const sim::SimulatorState& state) const;

  std::string folder_, last_;
};

}  // namespace palpate::node
