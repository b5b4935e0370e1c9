// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace palpate {

/// Phases of computing time. Those up to kOther form a cycle of the simulation and are measured in
/// its thread; haptics and publishing run in other threads.
enum class Phase {
  kContact,      ///< Search for candidates, motion along the tool path, touches.
  kForces,       ///< Energies and forces outside the line search: predictor, residual, report.
  kAssembly,     ///< Tangent matrices.
  kLinearSolve,  ///< Newton directions, with factorisations.
  kLineSearch,   ///< Energies and forces at trial points.
  kOther,        ///< Remainder of the cycle.
  kHaptics,      ///< One cycle of the force loop.
  kPublish       ///< Messages of one cycle.
};

inline constexpr std::size_t kNumPhases = 8;
inline constexpr std::size_t kNumCyclePhases = 6;  ///< Number of phases of a simulation cycle.

/// Name as in messages: "linear_solve".
std::string_view toString(Phase phase);

/// Time per phase [s]. For reports only; no result depends on it.
class PhaseTimes {
 public:
  double& operator[](Phase phase) { return seconds_[static_cast<std::size_t>(phase)]; }
  double operator[](Phase phase) const { return seconds_[static_cast<std::size_t>(phase)]; }

  PhaseTimes& operator+=(const PhaseTimes& other) {
    for (std::size_t k = 0; k < kNumPhases; ++k) seconds_[k] += other.seconds_[k];
    return *this;
  }
  /// Sum over the phases of a cycle [s].
  double cycle() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < kNumCyclePhases; ++k) sum += seconds_[k];
    return sum;
  }

 private:
  std::array<double, kNumPhases> seconds_{};
};

/// Time of a monotonic clock [s].
double steadySeconds();

/// Adds its lifetime to a phase. Overlapping timers of a thread count twice.
class PhaseTimer {
 public:
  /// Null `times`: measures nothing.
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
