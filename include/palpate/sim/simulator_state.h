// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/tissue/state.h"

namespace palpate::sim {

/// The memory of one tissue model.
struct ModelState {
  std::string model;                ///< Its name in the scene.
  std::vector<std::string> organs;  ///< That it owns, by name.
  tissue::State state;

  friend bool operator==(const ModelState& a, const ModelState& b) {
    return a.model == b.model && a.organs == b.organs && a.state == b.state;
  }
};

/// Everything that a simulator remembers from one cycle to the next. Who is given it back goes on
/// with the same bits as who went on without a break, in another process too. For the machine and
/// the version that wrote it.
struct SimulatorState {
  std::string scene;  ///< Its name.
  double time = 0.0;  ///< Simulated [s].
  std::vector<ModelState> models;
  std::string tools;  ///< Where the tools are and what the hands felt: bytes of a StateWriter.

  /// All of it as bytes.
  std::string bytes() const;
  /// @throws std::invalid_argument for bytes that are no state.
  static SimulatorState fromBytes(const std::string& bytes);

  friend bool operator==(const SimulatorState& a, const SimulatorState& b) {
    return a.scene == b.scene && a.time == b.time && a.models == b.models && a.tools == b.tools;
  }
  friend bool operator!=(const SimulatorState& a, const SimulatorState& b) { return !(a == b); }
};

}  // namespace palpate::sim
