// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <future>
#include <string>
#include <thread>
#include <vector>

namespace palpate::node {

/// Sees when the ROS master is gone, and registers this node again with the next one, which knows
/// nobody, or with one that was told to forget it, as `rosnode cleanup` does with nodes that do not
/// answer, or one of its topics or services. Connections that there are live on without a master.
class MasterWatch {
 public:
  /// `services`: resolved names of those that this node offers.
  explicit MasterWatch(std::vector<std::string> services);
  ~MasterWatch() { stop(); }

  void start();
  void stop();

 private:
  void loop();
  void look();
  /// Whether the master has all topics and services of this node; true where it does not answer.
  bool isKnown() const;
  void registerAgain() const;

  std::vector<std::string> services_;
  int pid_ = 0;  // of the master that knows us; 0: there is none
  std::promise<void> stopping_;
  std::thread thread_;
};

}  // namespace palpate::node
