// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/used_points.h"

#include <vector>

namespace palpate::mesh {

SurfaceMesh onlyUsedPoints(SurfaceMesh surface) {
  std::vector<int> number(static_cast<std::size_t>(surface.points.cols()), -1);
  for (const int i : surface.triangles.reshaped()) number[static_cast<std::size_t>(i)] = 0;
  int count = 0;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] < 0) continue;
    surface.points.col(count) = surface.points.col(static_cast<Eigen::Index>(i)).eval();
    number[i] = count++;
  }
  surface.points.conservativeResize(3, count);
  surface.triangles =
      surface.triangles.unaryExpr([&](int i) { return number[static_cast<std::size_t>(i)]; })
          .eval();
  return surface;
}

}  // namespace palpate::mesh
