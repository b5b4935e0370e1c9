// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

namespace palpate::node {

/// Coarsening of adaptive meshes such that kLateShare of the touching cycles have a load above
/// kMostLoad. Each such cycle raises the coarsening by a step, each other one lowers it by less,
/// and both balance at that share [stochastic approximation of a quantile: Robbins, Monro 1951].
class MeshGovernor {
 public:
  /// `most`: largest coarsening [-]; 1: none.
  explicit MeshGovernor(double most) : most_(std::log2(most)) {}

  /// Takes the load of a touching cycle: its duration over the period [-]. Returns the
  /// coarsening, >= 1: a power of 2^(1/4), or `most`.
  double observe(double load) {
    level_ += load > kMostLoad ? kStep * std::min(load / kMostLoad, kMostWeight)
                               : -kStep * kLateShare / (1.0 - kLateShare);
    level_ = std::clamp(level_, 0.0, most_);
    const double rounded = level_ < most_ ? std::round(4.0 * level_) / 4.0 : most_;
    const bool at_end = level_ == 0.0 || level_ == most_;
    if (at_end || std::abs(level_ - held_) > kHysteresis) held_ = std::min(rounded, most_);
    return coarsening();
  }
  double coarsening() const { return std::exp2(held_); }

 private:
  static constexpr double kMostLoad = 2.0;    // of one cycle, in periods [-]
  static constexpr double kLateShare = 0.1;   // share of cycles above that [-]
  static constexpr double kStep = 0.04;       // of log2 of the coarsening
  static constexpr double kMostWeight = 4.0;  // of one cycle, in steps
  static constexpr double kHysteresis = 0.2;  // of log2 of the coarsening

  double most_;
  double level_ = 0.0;  // log2 of the coarsening that balances
  double held_ = 0.0;   // log2 of that in effect
};

}  // namespace palpate::node
