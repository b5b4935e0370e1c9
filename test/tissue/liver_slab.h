// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <memory>
#include <string>

#include "palpate/fem/elasticity.h"
#include "palpate/tissue/fem/fem_tissue.h"
#include "step_forces.h"

namespace palpate::test {

/// A slab 100 x 100 x 40 mm of liver whose bottom is held.
struct LiverSlab {
  mesh::TetMesh mesh;
  fem::FreeMask free;
  tissue::FemSettings settings;
  material::Material law;
  double density = 1060.0;
  std::vector<material::PronyTerm> prony;

  explicit LiverSlab(const std::string& method,
                     const Eigen::Vector3i& cells = Eigen::Vector3i(8, 8, 4),
                     const std::string& element = "anp")
      : mesh(fem::meshFor(element, mesh::boxMesh(Vec3(0.1, 0.1, 0.04), cells))),
        free(fem::FreeMask::Ones(3, mesh.numPoints())),
        law(liver("stable_neo_hookean", 0.45)) {
    for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
      if (mesh.points(2, i) == 0.0) free.col(i).setZero();
    }
    settings.method = method;
    settings.element = element;
    settings.sample_spacing = 0.005;
  }
  static material::Material liver(const std::string& law, double poisson_ratio) {
    return material::makeMaterial(law,
                                  {{"young_modulus", {6.0e3}}, {"poisson_ratio", {poisson_ratio}}});
  }
  std::unique_ptr<tissue::TissueModel> make(ThreadPool* pool = nullptr) const {
    const fem::Composition composition{{material::Solid{law, density, prony}}, {}, {}};
    return tissue::makeFemTissue(mesh, composition, free, settings, pool);
  }
};

/// A ball of 10 mm over the middle of the slab, from above to `depth` at `speed` and held there.
class LiverPress {
 public:
  explicit LiverPress(double depth, double speed, double step = 0.01)
      : depth_(depth), speed_(speed), step_(step) {}

  contact::Obstacle next() {
    const contact::Obstacle body{&shape_, 0, at(t_), at(t_ + step_)};
    t_ += step_;
    return body;
  }
  double time() const { return t_; }

 private:
  Pose at(double t) const {
    const double z = std::max(0.052 - speed_ * t, 0.05 - depth_);
    return poseFromXyzRpy(Vec3(0.05, 0.05, z), Vec3::Zero());
  }
  instrument::Geometry shape_ = instrument::Sphere{0.01};
  double depth_, speed_, step_, t_ = 0.0;
};

}  // namespace palpate::test
