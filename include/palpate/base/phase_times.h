// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace palpate {

/// What time is spent on. The first ones, up to kOther, make up a cycle of the simulation and are
/// measured in its thread; haptics and publishing go on beside it.
enum class Phase {
  kContact,      ///< Search for what may touch, sweeping, collecting what touches.
  kForces,       ///< Energies and forces outside the line search: predictor, balance, report.
  kAssembly,     ///< Tangent matrices.
  kLinearSolve,  ///< Directions of Newton's method, factorisations included.
  kLineSearch,   ///< Energies and forces at the points tried.
  kOther,        ///< What is left of the cycle.
  kHaptics,      ///< One cycle of the force loop.
  kPublish       ///< Messages of one cycle.
};

inline constexpr std::size_t kNumPhases = 8;
inline constexpr std::size_t kNumCyclePhases = 6;  ///< Those of a cycle of the simulation.

/// As in messages: "linear_solve".
std::string_view toString(Phase phase);

/// Seconds by phase. Only ever reported: no result depends on them.
class PhaseTimes {
 public:
  double& operator[](Phase phase) { return seconds_[static_cast<std::size_t>(phase)]; }
  double operator[](Phase phase) const { return seconds_[static_cast<std::size_t>(phase)]; }

  PhaseTimes& operator+=(const PhaseTimes& other) {
    for (std::size_t k = 0; k < kNumPhases; ++k) seconds_[k] += other.seconds_[k];
    return *this;
  }
  /// Of the phases of a cycle [s].
  double cycle() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < kNumCyclePhases; ++k) sum += seconds_[k];
    return sum;
  }

 private:
  std::array<double, kNumPhases> seconds_{};
};

/// Time of a clock that never goes back, since some moment [s].
double steadySeconds();

/// Adds the time of its life to a phase. Timers of one thread must not overlap, or the time counts
/// twice.
class PhaseTimer {
 public:
  /// `times` may be null: nothing is measured.
  PhaseTimer(PhaseTimes* times, Phase phase)
      : times_(times), phase_(phase), begin_(times ? steadySeconds() : 0.0) {}
  ~PhaseTimer() {
    if (times_) (*times_)[phase_] += steadySeconds() - begin_;
  }
  PhaseTimer(const PhaseTimer&) = delete;
  PhaseTimer& operator=(const PhaseTimer&) = delete;

 private:
  PhaseTimes* times_;
  Phase phase_;
  double begin_;
};

}  // namespace palpate
