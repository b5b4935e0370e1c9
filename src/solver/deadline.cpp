// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/deadline.h"

#include <algorithm>

namespace palpate::solver {
namespace {

// Decay of the remembered delay after a shorter one, per cycle [-].
constexpr double kRemembers = 0.95;

}  // namespace

void Deadline::begin(double now, double cycles) {
  given_ = cycles * seconds_;
  ask_at_ = now + std::max(0.0, given_ - landing_);
  asked_ = false;
}

bool Deadline::isLate(double now) {
  if (now < ask_at_) return false;
  asked_ = true;
  return true;
}

void Deadline::end(double now) {
  if (!asked_) return;
  // Bounded by the given time; otherwise later quick cycles would be cut at once for as long.
  landing_ = std::min(std::max(now - ask_at_, kRemembers * landing_), given_);
}

}  // namespace palpate::solver
