// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/state_bytes.h"
#include "palpate/solver/status.h"

namespace palpate::tissue {

/// Backoff after repeated failures: an organ that failed in kFailures consecutive cycles is
/// skipped, which bounds the scene's time per cycle. It is retried when the tools have left it,
/// after a reset, and every kRetryCycles. A retry that fails without a near tool is permanent.
class FailureBackoff {
 public:
  static constexpr int kFailures = 10;     ///< Consecutive failures before cycles are skipped.
  static constexpr int kRetryCycles = 50;  ///< Skipped cycles before a retry.

  /// Whether the cycle is skipped; `touched`: a tool may touch the organ. Called once a cycle.
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
  /// Whether all cycles except retries are skipped.
  bool fails() const { return failures_ >= kFailures; }
  /// Whether a failed retry is permanent.
  /// @pre Called before failed().
  bool isForGood() const { return fails() && !touched_; }
  void solved() { failures_ = waited_ = 0; }
  void failed(solver::SolveStatus status) {
    ++failures_;
    waited_ = 0;
    status_ = status;
  }
  /// Status of the last failure.
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
