// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace palpate::tissue {

/// State of a tissue model between cycles: opaque bytes, comparable.
struct State {
  /// Model, method and size in words; a state can be restored only to its own kind.
  std::string kind;
  std::string bytes;  ///< Bytes of a StateWriter.

  friend bool operator==(const State& a, const State& b) {
    return a.kind == b.kind && a.bytes == b.bytes;
  }
  friend bool operator!=(const State& a, const State& b) { return !(a == b); }
};

/// @throws std::invalid_argument unless state.kind is `kind`.
inline void checkKind(const State& state, const std::string& kind) {
  if (state.kind == kind) return;
  throw std::invalid_argument("the state is one of '" + state.kind + "', not of '" + kind + "'");
}

}  // namespace palpate::tissue
