// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace palpate::tissue {

/// All that a tissue model remembers from one cycle to the next. Opaque to everybody else; equal
/// where the memories are.
struct State {
  /// Which model, how it is solved and how large it is, in words: a state can go back only to
  /// its own kind.
  std::string kind;
  std::string bytes;  ///< Written by a StateWriter.

  friend bool operator==(const State& a, const State& b) {
    return a.kind == b.kind && a.bytes == b.bytes;
  }
  friend bool operator!=(const State& a, const State& b) { return !(a == b); }
};

/// @throws std::invalid_argument unless the state is of this kind.
inline void checkKind(const State& state, const std::string& kind) {
  if (state.kind == kind) return;
  throw std::invalid_argument("the state is one of '" + state.kind + "', not of '" + kind + "'");
}

}  // namespace palpate::tissue
