// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "palpate/sim/simulator.h"

namespace palpate::node {

/// What a replay was like, as a table.
class ReplaySummary {
 public:
  explicit ReplaySummary(const scene::Scene& scene);

  void add(const sim::StepResult& result, double cycle_ms);
  void print(std::ostream& out, double simulated, double wall, long dropped) const;

 private:
  std::vector<std::string> names_;
  std::vector<double> peak_force_;  // [N]
  double mesh_error_ = 0.0;         // [N]
  int contacts_ = 0;
  long unsolved_ = 0, skipped_ = 0;
  std::vector<double> cycle_ms_;
};

}  // namespace palpate::node
