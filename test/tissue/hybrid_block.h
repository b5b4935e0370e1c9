// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "model_variants.h"

namespace palpate::test {

inline const Vec3 kSize(0.06, 0.06, 0.03);
inline const mesh::TetRegion kNone = mesh::SphereRegion{Vec3::Constant(10.0), 0.01};
inline const mesh::TetRegion kAll = mesh::SphereRegion{Vec3::Zero(), 1.0};
inline const mesh::TetRegion kHalf = mesh::BoxRegion{Vec3::Constant(-1.0), Vec3(0.031, 1.0, 1.0)};

/// A block that is held at its bottom, or as the test says.
struct HybridBlock {
  OrganSketch organ;
  tissue::ModelSettings settings;
  std::function<void(tissue::Surroundings*)> around;

  explicit HybridBlock(const mesh::TetRegion& region = kHalf)
      : organ(block("block", Vec3::Zero(), kSize, Eigen::Vector3i(6, 6, 4),
                    [](const Vec3& X) { return X.z() <= 0.0; })) {
    organ.damping = {20.0, 0.0};
    organ.element = "tet4";
    organ.hybrid.region = region;
    settings = variantSettings();
    settings.gravity = Vec3(1.0, 2.0, -9.81);
    settings.tolerance = 1e-9;
    settings.position_tolerance = 1e-13;
    settings.linear_tolerance = 1e-3;
    settings.max_newton_iterations = 100;
    settings.contact.model = "penalty";  // one answer, whatever came before
  }
  std::unique_ptr<tissue::TissueModel> make(const std::string& model) const {
    tissue::ModelDescription description;
    description.organs.push_back(organ.describe());
    if (around) {
      description.organs.back().surroundings = [this](const mesh::TetMesh&) {
        tissue::Surroundings s(organ.free);
        around(&s);
        return s;
      };
    }
    description.settings = settings;
    return tissue::makeModel(model, description);
  }
};

/// A ball of 8 mm that comes down at (x, 0.03) and stays 3 mm deep.
inline contact::Obstacle ballAt(double x, double t) {
  static const instrument::Geometry kBall = instrument::Sphere{0.008};
  const auto at = [x](double s) {
    return Pose(Eigen::Translation3d(x, 0.03, 0.038 - std::min(0.05 * s - 0.002, 0.003)));
  };
  return {&kBall, 0, at(t), at(t + kStep)};
}

struct Held {
  Vec3 force, support;
  Points x;
  tissue::TissueStep step;
};

inline Held hold(tissue::TissueModel* tissue, double x, double seconds) {
  Held held;
  for (int k = 0; k * kStep < seconds; ++k) held.step = tissue->step({ballAt(x, k * kStep)}, kStep);
  EXPECT_TRUE(held.step.ok()) << solver::toString(held.step.status);
  held.force = onTool(held.step);
  held.support = held.step.support_force;
  held.x = tissue->positions();
  return held;
}

// Over the displacements of b.
inline double difference(const Points& a, const Points& b, const Points& X) {
  return (a - b).norm() / (b - X).norm();
}

}  // namespace palpate::test
