// SPDX-License-Identifier: GPL-3.0-or-later
// Would it pay to freeze what is far from contact? A linear solve of a step of 10 ms in which only
// the nodes nearest to the load may move, and what is then left of the residual of the whole body.
#include <algorithm>
#include <string>
#include <vector>

#include "body.h"
#include "palpate/fem/supports.h"
#include "palpate/solver/block_pcg.h"

namespace palpate::micro {
namespace {

// 1 for the components of the `count` nodes that are nearest to the middle of the top.
fem::FreeMask nearestNodes(const Body& body, std::size_t count) {
  const Vec3 top(0.05, 0.05, 0.1);
  std::vector<std::pair<double, Eigen::Index>> nodes;
  for (Eigen::Index i = 0; i < body.mesh.numPoints(); ++i) {
    nodes.emplace_back((body.mesh.points.col(i) - top).norm(), i);
  }
  std::sort(nodes.begin(), nodes.end());
  fem::FreeMask free = fem::FreeMask::Zero(3, body.mesh.numPoints());
  for (std::size_t k = 0; k < std::min(count, nodes.size()); ++k) {
    free.col(nodes[k].second).setOnes();
  }
  return free;
}

void frozenRegion(benchmark::State& state, int cells, int percent_moving) {
  const Body body(cells, "anp", "stable_neo_hookean");
  const fem::Stiffness A = stepMatrix(body);
  const Points b = pushOnTop(body);
  const auto nodes = static_cast<std::size_t>(body.mesh.numPoints());
  const fem::FreeMask free = nearestNodes(body, nodes * percent_moving / 100);
  fem::Stiffness frozen = A;
  frozen.constrain(free);
  Points x, Ax;
  solver::BlockPcg solver(1000);
  for (auto _ : state) solver.solve(frozen, b.cwiseProduct(free), 1e-6, &x);
  A.multiply(x, &Ax);
  state.counters["residual_left"] = (b - Ax).norm() / b.norm();
}

const bool kAdded = [] {
  for (const int cells : {9, 15}) {
    for (const int percent : {10, 30, 50, 70, 90}) {
      const std::string name = "frozen_region/tets:" + std::to_string(6 * cells * cells * cells) +
                               "/moving:" + std::to_string(percent) + "%";
      benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
        frozenRegion(state, cells, percent);
      })->Unit(benchmark::kMillisecond);
    }
  }
  return true;
}();

}  // namespace
}  // namespace palpate::micro
