// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/fem/elasticity.h"
#include "slab.h"
#include "tissue/adaptation/adaptive_tissue.h"

namespace palpate::test {

/// A slab with a coarse mesh of 25 mm, for a ball of 10 mm.
struct AdaptiveSlab : Slab {
  explicit AdaptiveSlab(const std::string& element = "anp",
                        const Eigen::Vector3i& cells = Eigen::Vector3i(4, 4, 2))
      : Slab(cells) {
    mesh = fem::meshFor(element, mesh);
    holdBottom();
    settings.element = element;
    settings.gravity.setZero();
    settings.mass_damping = 5.0;
    settings.position_tolerance = 1e-7;
    settings.sample_spacing = 0.003;
    adapt.finest = 0.005;
  }
  std::unique_ptr<tissue::TissueModel> make(ThreadPool* pool = nullptr) const {
    return makeAdaptiveTissue(mesh, composition, free, settings, adapt, pool);
  }

  tissue::AdaptSettings adapt;
  fem::Composition composition = fem::Composition::uniform(
      material::makeMaterial("neo_hookean",
                             {{"young_modulus", {6.0e3}}, {"poisson_ratio", {0.45}}}),
      1060.0);
};

class Ball {
 public:
  explicit Ball(const Vec3& at) { at_.translation() = at; }
  /// Goes to `to` [m] within a cycle.
  std::vector<contact::Obstacle> to(const Vec3& to) {
    const Pose begin = at_;
    at_.translation() = to;
    return {{&shape_, 0, begin, at_}};
  }

 private:
  instrument::Geometry shape_ = instrument::Sphere{0.01};
  Pose at_ = Pose::Identity();
};

}  // namespace palpate::test
