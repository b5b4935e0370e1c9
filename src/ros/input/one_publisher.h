// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/weak_ptr.hpp>
#include <string>

#include "ros/program/throttle.h"

namespace palpate::node {

/// Of all who publish an input the one that is listened to: the first, until it is silent or its
/// connection is gone. Two hands on one tool would throw it to and fro. Names are what publishers
/// say of themselves, so it goes by connections.
class OnePublisher {
 public:
  /// Something that lives as long as a connection does.
  using Connection = boost::shared_ptr<const void>;

  /// `patience` [s]: so long a silence ends a publisher's turn, or a conflict.
  explicit OnePublisher(double patience) : patience_(seconds(patience)) {}

  /// A message came by `connection` of a publisher that calls itself `name`, at `now`; whether it
  /// counts.
  bool takes(const Connection& connection, const std::string& name, Steady::time_point now) {
    const Connection current = connection_.lock();
    if (!current || current == connection || now - heard_ > patience_) {
      if (connection == other_connection_.lock()) other_.clear();
      connection_ = connection;
      name_ = name;
      heard_ = now;
      return true;
    }
    other_connection_ = connection;
    other_ = name;
    other_heard_ = now;
    return false;
  }
  /// Names both, while two publish; else "".
  std::string conflict(Steady::time_point now) const {
    if (other_.empty() || now - other_heard_ > patience_) return "";
    if (other_ == name_) return "two call themselves " + name_ + " and publish it; only one counts";
    return name_ + " and " + other_ + " both publish it; only " + name_ + " counts";
  }

 private:
  Steady::duration patience_;
  boost::weak_ptr<const void> connection_, other_connection_;
  std::string name_, other_;
  Steady::time_point heard_, other_heard_;
};

}  // namespace palpate::node
