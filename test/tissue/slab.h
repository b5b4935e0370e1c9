// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <memory>

#include "palpate/mesh/tet_mesh.h"
#include "palpate/tissue/fem/fem_tissue.h"
#include "step_forces.h"

namespace palpate::test {

inline const material::Material kLiver = material::makeMaterial(
    "stable_neo_hookean", {{"young_modulus", {6.0e3}}, {"poisson_ratio", {0.45}}});
constexpr double kStep = 0.01;

/// A slab 100 x 100 x 40 mm whose bottom is held.
struct Slab {
  mesh::TetMesh mesh;
  fem::FreeMask free;
  tissue::FemSettings settings;

  explicit Slab(const Eigen::Vector3i& cells = Eigen::Vector3i(8, 8, 4))
      : mesh(mesh::boxMesh(Vec3(0.1, 0.1, 0.04), cells)) {
    holdBottom();
    settings.gravity = Vec3(0.0, 0.0, -9.81);
    settings.sample_spacing = 0.005;
  }
  void holdBottom() {
    free = fem::FreeMask::Ones(3, mesh.numPoints());
    for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
      if (mesh.points(2, i) == 0.0) free.col(i).setZero();
    }
  }
  std::unique_ptr<tissue::TissueModel> make(ThreadPool* pool = nullptr) const {
    return tissue::makeFemTissue(mesh, fem::Composition::uniform(kLiver, 1060.0), free, settings,
                                 pool);
  }
};

/// A sphere pressed in from above, dragged sideways and lifted, 30 mm/s.
class Press {
 public:
  contact::Obstacle next() {
    contact::Obstacle body{&shape_, 0, at(t_), at(t_ + kStep)};
    t_ += kStep;
    return body;
  }
  bool done() const { return t_ > 1.5; }

 private:
  static Pose at(double t) {
    const double down = 0.03 * std::min(t, 0.5), aside = 0.03 * std::clamp(t - 0.5, 0.0, 0.5);
    const double up = 0.06 * std::clamp(t - 1.0, 0.0, 0.5);
    return poseFromXyzRpy(Vec3(0.04 + aside, 0.05, 0.054 - down + up), Vec3::Zero());
  }
  instrument::Geometry shape_ = instrument::Sphere{0.01};
  double t_ = 0.0;
};

}  // namespace palpate::test
