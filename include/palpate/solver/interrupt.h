// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

namespace palpate::solver {

/// Asked now and then in a solve: true when it should end with the best state so far. The core has
/// no clock; whoever has one gives it.
using Interrupt = std::function<bool()>;

/// Whether it is there, not null and not empty, and asks for the end.
inline bool isInterrupted(const Interrupt* interrupt) {
  return interrupt != nullptr && *interrupt && (*interrupt)();
}

}  // namespace palpate::solver
