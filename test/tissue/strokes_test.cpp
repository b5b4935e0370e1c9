// SPDX-License-Identifier: GPL-3.0-or-later
// Thin tools that are struck into a coarse block at 1 m/s, in cycles of 20 ms. PALPATE_STROKES says
// how many of each kind are tried.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "palpate/contact/overlap.h"
#include "palpate/contact/signed_distance.h"
#include "slab.h"
#include "support/random.h"

namespace palpate::tissue::strokes_test {
namespace {

using test::Slab;

constexpr double kCycle = 0.02, kSpeed = 1.0;  // [s], [m/s]

struct StruckTool {
  const char* name;
  instrument::Geometry geometry;
  double half_length;  // along its z axis [m]
};

const StruckTool kRod{"rod", instrument::Capsule{1.5e-3, 0.04}, 0.0415};
const StruckTool kFlatRod{"flat_rod", instrument::Cylinder{1.5e-3, 0.04}, 0.04};
const StruckTool kNeedle{"needle", instrument::Capsule{2.5e-4, 0.04}, 0.04025};
const StruckTool kBlade{"blade", instrument::Box{Vec3(5e-3, 1e-4, 0.02)}, 0.02};

int numStrokes() {
  const char* wanted = std::getenv("PALPATE_STROKES");
  return wanted ? std::stoi(wanted) : 8;
}

class Strokes : public ::testing::TestWithParam<StruckTool> {
 protected:
  Strokes() {
    slab.mesh = mesh::boxMesh(Vec3(0.06, 0.06, 0.03), Eigen::Vector3i(6, 6, 3));
    slab.holdBottom();
    slab.settings.gravity.setZero();
    slab.settings.sample_spacing =
        std::max(5e-4, 0.5 * contact::inscribedRadius(GetParam().geometry));
    tissue = slab.make();
  }

  // Above the block, its lower end first and inclined up to 45 degrees.
  Pose begin() {
    const Vec3 tilt = random.vector(0.55), at = random.vector(0.02);
    const Pose turned = poseFromXyzRpy(Vec3::Zero(), Vec3(tilt.x(), tilt.y(), 3.0 * tilt.z()));
    const Vec3 end(0.03 + at.x(), 0.03 + at.y(), 0.031 + 0.2 * std::abs(at.z()));
    Pose X_WG = turned;
    X_WG.translation() = end + GetParam().half_length * turned.linear().col(2);
    return X_WG;
  }
  Pose end(const Pose& from) {
    Vec3 way = random.vector(1.0);
    way.z() = -1.0;
    Pose to = from;
    to.translation() += kSpeed * kCycle * way.normalized();
    return to;
  }
  // Whether the tool's axis is in the block's rest volume; some strokes pass by it at the end.
  bool pressesIn(const Pose& X_WG) const {
    const Vec3 size(0.06, 0.06, 0.03);
    for (double s = -1.0; s <= 1.0; s += 0.01) {
      const Vec3 p = X_WG.translation() + s * GetParam().half_length * X_WG.linear().col(2);
      if ((p.array() > 0.0).all() && (p.array() < size.array()).all()) return true;
    }
    return false;
  }
  bool wrong(const Pose& X_WG) const {
    const SurfaceState shape = tissue->surfaceState(0);
    return contact::hasSunkIn(GetParam().geometry, X_WG, shape.positions, shape.triangles);
  }

  test::Random random;
  Slab slab;
  std::unique_ptr<TissueModel> tissue;
};

TEST_P(Strokes, EndWithTheToolOutside) {
  int inside = 0, inverted = 0, unsolved = 0, lost = 0, not_back = 0;
  const int strokes = numStrokes();
  for (int stroke = 0; stroke < strokes; ++stroke) {
    tissue->reset();
    contact::Obstacle tool{&GetParam().geometry, 0, begin(), Pose()};
    tool.X_WG_end = tool.X_WG_begin;
    ASSERT_FALSE(wrong(tool.X_WG_begin));
    tissue->step({tool}, kCycle);
    tool.X_WG_end = end(tool.X_WG_begin);
    const TissueStep& struck = tissue->step({tool}, kCycle);
    ASSERT_TRUE(tissue->positions().allFinite());
    inverted += struck.min_jacobian <= 0.0;
    unsolved += !struck.ok() && struck.status != solver::SolveStatus::kInverted;
    lost += struck.contacts.empty() && pressesIn(tool.X_WG_end);
    inside += wrong(tool.X_WG_end);
    // Drawn back, it is free.
    std::swap(tool.X_WG_begin, tool.X_WG_end);
    tissue->step({tool}, kCycle);
    tool.X_WG_begin = tool.X_WG_end;
    for (int cycle = 0; cycle < 3; ++cycle) tissue->step({tool}, kCycle);
    not_back += tissue->step({tool}, kCycle).tools_inside > 0;
  }
  RecordProperty("strokes", strokes);
  std::printf("%s: of %d strokes %d inside, %d without force, %d inverted, %d unsolved, %d held\n",
              GetParam().name, strokes, inside, lost, inverted, unsolved, not_back);
  EXPECT_EQ(inside, 0);
  EXPECT_EQ(inverted, 0);
  EXPECT_EQ(lost, 0);
  EXPECT_EQ(not_back, 0);
}

INSTANTIATE_TEST_SUITE_P(Of, Strokes, ::testing::Values(kRod, kFlatRod, kNeedle, kBlade),
                         [](const auto& param) { return std::string(param.param.name); });

}  // namespace
}  // namespace palpate::tissue::strokes_test
