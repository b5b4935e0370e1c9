// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "palpate/io/json.h"
#include "palpate/springs/spring_grids.h"
#include "parts.h"
#include "rest.h"

namespace palpate::models {

using namespace springs;

std::string freeSheet(bool /*quick*/) {
  constexpr int n = 21, middle = n / 2;
  const double U = 1.0;
  const TriangleSprings springs = bendingTriangleSprings({1.0e6, 0.3, 0.01}, U);
  const SpringNetwork sheet = triangleNetwork(springs, U, triangleNodes(n, n), 1.0);
  const auto node = [](int row, int column) { return Eigen::Index{row} * n + column; };
  NetworkLoads loads = noLoads(sheet);
  loads.free.row(2).setZero();
  loads.free.col(node(middle, middle)).setZero();
  loads.free(1, node(middle, middle + 1)) = 0.0;
  Points x = sheet.points;
  comeToRest(sheet, loads, 1e-10 * springs.structural.preload, &x);

  const auto change = [&](Eigen::Index a, Eigen::Index b) {
    return (x.col(b) - x.col(a)).norm() / U - 1.0;
  };
  Eigen::VectorXd along(n - 1), across(n - 1);
  for (int i = 0; i < n - 1; ++i) {
    along[i] = change(node(middle, i), node(middle, i + 1));
    across[i] = change(node(i, middle), node(i + 1, middle));
  }
  const auto inside = [](int i, int nodes) {
    const int row = i / n, column = i % n;
    return std::min({row, column, n - 1 - row, n - 1 - column}) >= nodes;
  };
  double worst = 0.0;
  for (const Spring& s : sheet.springs) {
    if (s.kind != SpringKind::kStructural || !inside(s.a, 3) || !inside(s.b, 3)) continue;
    worst = std::max(worst, std::abs(change(s.a, s.b)));
  }
  io::JsonMembers out;
  out.add("along_the_middle_row", io::json(along));
  out.add("across_the_rows", io::json(across));
  out.add("worst_three_nodes_inside", worst);
  return out.object();
}

}  // namespace palpate::models
