// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/sim/simulator_state.h"

#include <cmath>

#include "palpate/base/state_bytes.h"

namespace palpate::sim {

std::string SimulatorState::bytes() const {
  StateWriter out;
  out.put(scene);
  out.put(time);
  out.put(static_cast<std::int64_t>(models.size()));
  for (const ModelState& model : models) {
    out.put(model.model);
    out.put(model.organs);
    out.put(model.state.kind);
    out.put(model.state.bytes);
  }
  out.put(tools);
  return out.bytes();
}

SimulatorState SimulatorState::fromBytes(const std::string& bytes) {
  StateReader in(bytes);
  SimulatorState state;
  in.get(&state.scene);
  in.get(&state.time);
  if (!std::isfinite(state.time)) StateReader::fail();
  state.models.resize(static_cast<std::size_t>(in.count(4 * sizeof(std::int64_t))));
  for (ModelState& model : state.models) {
    in.get(&model.model);
    in.get(&model.organs);
    in.get(&model.state.kind);
    in.get(&model.state.bytes);
  }
  in.get(&state.tools);
  in.finish();
  return state;
}

}  // namespace palpate::sim
