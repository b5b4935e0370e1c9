// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "throttle.h"

namespace palpate::node {

/// Of all who publish an input the one that is listened to: the first, until it is silent. Two
/// hands on one tool would throw it to and fro.
class OnePublisher {
 public:
  /// `patience` [s]: so long a silence ends a publisher's turn, or a conflict.
  explicit OnePublisher(double patience) : patience_(seconds(patience)) {}

  /// A message of `name` came at `now`; whether it counts.
  bool takes(const std::string& name, Steady::time_point now) {
    if (name == name_ || name_.empty() || now - heard_ > patience_) {
      if (name == other_) other_.clear();
      name_ = name;
      heard_ = now;
      return true;
    }
    other_ = name;
    other_heard_ = now;
    return false;
  }
  /// Names both, while two publish; else "".
  std::string conflict(Steady::time_point now) const {
    if (other_.empty() || now - other_heard_ > patience_) return "";
    return name_ + " and " + other_ + " both publish it; only " + name_ + " counts";
  }

 private:
  Steady::duration patience_;
  std::string name_, other_;
  Steady::time_point heard_, other_heard_;
};

}  // namespace palpate::node
