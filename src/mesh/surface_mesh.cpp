// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/surface_mesh.h"

namespace palpate::mesh {

double enclosedVolume(const SurfaceMesh& surface) {
  double volume = 0.0;
  for (Eigen::Index t = 0; t < surface.triangles.cols(); ++t) {
    const Eigen::Vector3i v = surface.triangles.col(t);
    volume += surface.points.col(v[0]).dot(
                  Vec3(surface.points.col(v[1])).cross(Vec3(surface.points.col(v[2])))) /
              6.0;
  }
  return volume;
}

}  // namespace palpate::mesh
