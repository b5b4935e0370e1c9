// SPDX-License-Identifier: GPL-3.0-or-later
#include "element_schedule.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace palpate::fem {
namespace {

// Slab of each node, with equal numbers of nodes up to one.
std::vector<int> slabs(const Points& X) {
  const Vec3 size = X.rowwise().maxCoeff() - X.rowwise().minCoeff();
  int axis = 0;
  size.maxCoeff(&axis);
  const auto n = static_cast<std::size_t>(X.cols());
  std::vector<int> order(n), slab(n);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return X(axis, a) < X(axis, b); });
  for (std::size_t k = 0; k < n; ++k) {
    slab[order[k]] = static_cast<int>(kScheduleParts * k / n);
  }
  return slab;
}

}  // namespace

std::vector<ElementRun> ElementSchedule::runs() const {
  std::vector<ElementRun> runs;
  for (const std::vector<Part>& parts : phases) {
    for (const Part& part : parts) runs.insert(runs.end(), part.begin(), part.end());
  }
  return runs;
}

ElementSchedule scheduleElements(const mesh::TetMesh& mesh, const Composition& composition) {
  const std::vector<int> slab = slabs(mesh.points);
  std::vector<std::pair<int, int>> order;  // smallest node, element
  order.reserve(static_cast<std::size_t>(mesh.numTets()));
  for (int e = 0; e < mesh.numTets(); ++e) order.emplace_back(mesh.tets.col(e).minCoeff(), e);
  std::sort(order.begin(), order.end());

  std::map<std::pair<int, int>, std::map<int, std::vector<int>>> parts;  // (phase, part), solid
  for (const auto& [node, e] : order) {
    int low = kScheduleParts, high = 0;
    for (int a = 0; a < mesh.tets.rows(); ++a) {
      low = std::min(low, slab[mesh.tets(a, e)]);
      high = std::max(high, slab[mesh.tets(a, e)]);
    }
    const int phase = low == high ? 0 : low / 2 == high / 2 ? 1 : 2;
    const int part = phase == 0 ? low : phase == 1 ? low / 2 : 0;
    const int solid = composition.solid_of.empty() ? 0 : composition.solid_of[e];
    parts[{phase, part}][solid].push_back(e);
  }
  ElementSchedule schedule;
  schedule.phases.resize(3);
  for (auto& [key, runs] : parts) {
    ElementSchedule::Part part;
    for (auto& [solid, elements] : runs) part.push_back({solid, std::move(elements)});
    schedule.phases[key.first].push_back(std::move(part));
  }
  return schedule;
}

}  // namespace palpate::fem
