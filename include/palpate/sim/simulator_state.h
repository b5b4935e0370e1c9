// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/tissue/state.h"

namespace palpate::sim {

/// State of one tissue model.
struct ModelState {
  std::string model;                ///< Name of the model in the scene.
  std::vector<std::string> organs;  ///< Names of its organs.
  tissue::State state;

  friend bool operator==(const ModelState& a, const ModelState& b) {
    return a.model == b.model && a.organs == b.organs && a.state == b.state;
  }
};

/// Whole state of a simulator between cycles. A restored simulator continues bitwise equally, in
/// other processes too. Valid for the machine and version that wrote it.
struct SimulatorState {
  std::string scene;  ///< Name of the scene.
  double time = 0.0;  ///< Simulated time [s].
  std::vector<ModelState> models;
  std::string tools;  ///< Tool poses and wrenches, as bytes of a StateWriter.

  /// The state as bytes.
  std::string bytes() const;
  /// @throws std::invalid_argument for bytes of no state.
  static SimulatorState fromBytes(const std::string& bytes);

  friend bool operator==(const SimulatorState& a, const SimulatorState& b) {
    return a.scene == b.scene && a.time == b.time && a.models == b.models && a.tools == b.tools;
  }
  friend bool operator!=(const SimulatorState& a, const SimulatorState& b) { return !(a == b); }
};

}  // namespace palpate::sim
