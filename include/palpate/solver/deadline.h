// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace palpate::solver {

/// When a cycle that must end by its deadline is asked to: earlier than that by what cycles took
/// lately from being asked to their end, for an iteration may be under way and one is still to
/// follow. Times are of any one clock [s]. As an Interrupt:
///
///   Deadline deadline(0.02);
///   simulator.setInterrupt([&] { return deadline.isLate(now()); });
///   deadline.begin(now()), simulator.step(...), deadline.end(now());   // each cycle
class Deadline {
 public:
  /// `seconds` > 0 after its begin() a cycle is to end.
  explicit Deadline(double seconds) : seconds_(seconds), landing_(0.5 * seconds) {}

  /// A cycle begins, or `cycles` of them that are looked at as one.
  void begin(double now, double cycles = 1.0);
  /// Whether the cycle is to end now.
  bool isLate(double now);
  /// It has ended.
  void end(double now);

 private:
  double seconds_, landing_;
  double ask_at_ = 0.0, given_ = 0.0;
  bool asked_ = false;
};

}  // namespace palpate::solver
