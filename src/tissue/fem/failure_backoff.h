// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/state_bytes.h"
#include "palpate/solver/status.h"

namespace palpate::tissue {

/// An organ that failed in cycle after cycle is left where it is, rather than have each cycle of
/// the scene take as long as all its attempts do. It is tried again when the tools have left it,
/// when it was placed anew, and now and then. One that fails then, with no tool near, would do so
/// for good.
class FailureBackoff {
 public:
  static constexpr int kFailures = 10;     ///< One after the other.
  static constexpr int kRetryCycles = 50;  ///< Cycles.

  /// Whether the cycle that begins is left out; `touched`: a tool may touch the organ.
  bool holds(bool touched) {
    const bool left = touched_ && !touched;
    touched_ = touched;
    if (failures_ < kFailures || left || waited_ >= kRetryCycles) {
      waited_ = 0;
      return false;
    }
    ++waited_;
    return true;
  }
  /// Whether it failed so often that only a trial is not left out.
  bool fails() const { return failures_ >= kFailures; }
  /// Asked in a trial that failed, before failed(): whether no other one would do better.
  bool isForGood() const { return fails() && !touched_; }
  void solved() { failures_ = waited_ = 0; }
  void failed(solver::SolveStatus status) {
    ++failures_;
    waited_ = 0;
    status_ = status;
  }
  /// Of the last failure.
  solver::SolveStatus status() const { return status_; }

  void save(StateWriter* out) const {
    out->put(failures_);
    out->put(waited_);
    out->put(touched_);
    out->put(status_);
  }
  void restore(StateReader* in) {
    in->get(&failures_);
    in->get(&waited_);
    in->get(&touched_);
    in->get(&status_);
    if (failures_ < 0 || waited_ < 0 || !(status_ <= solver::SolveStatus::kNonFinite)) {
      StateReader::fail();
    }
  }

 private:
  int failures_ = 0, waited_ = 0;
  bool touched_ = false;
  solver::SolveStatus status_ = solver::SolveStatus::kConverged;
};

}  // namespace palpate::tissue
