// SPDX-License-Identifier: GPL-3.0-or-later
// The shipped graspers take the gallbladder, lift it from the liver, lower it and let it go.
#include <algorithm>

#include "shipped_replay.h"

namespace palpate::sim::bimanual_scene_test {
namespace {

// Times of the shipped trajectory [s]: jaws closed, lifted, about to lower, lowered, open, end.
constexpr double kClosed = 2.7, kLifted = 3.9, kHeld = 4.9, kLowered = 6.1, kOpen = 7.0, kEnd = 8.4;
constexpr double kStiffness = 2.0e4;  // of the tissue below, in every direction [Pa/m]

double top(const Points& x) { return x.row(2).maxCoeff(); }

Vec3 onTools(const StepResult& result) {
  return result.instruments[0].spatial.force + result.instruments[1].spatial.force;
}

// What the connective tissue draws the gallbladder back with [N]: of each face below 5 mm in the
// organ's frame its area times the mean displacement of its corners.
Vec3 drawnBack(const test::ShippedReplay& replay, int organ) {
  const Simulator& simulator = replay.simulator();
  const scene::Scene& scene = simulator.scene();
  const Points rest = simulator.cells(organ).points;
  const Points own = scene.organs[organ].pose.pose().inverse() * rest;
  const tissue::SurfaceState shape = simulator.surfaceState(organ);
  Vec3 force = Vec3::Zero();
  for (Eigen::Index f = 0; f < shape.triangles.cols(); ++f) {
    const Eigen::Vector3i t = shape.triangles.col(f);
    if (std::max({own(2, t[0]), own(2, t[1]), own(2, t[2])}) > 0.005) continue;
    const Vec3 a = rest.col(t[1]) - rest.col(t[0]), b = rest.col(t[2]) - rest.col(t[0]);
    Vec3 u = Vec3::Zero();
    for (int k = 0; k < 3; ++k) u += (shape.positions.col(t[k]) - rest.col(t[k])) / 3.0;
    force -= kStiffness * 0.5 * a.cross(b).norm() * u;
  }
  return force;
}

TEST(BimanualScene, LiftsByTheForceOfTheTissueBelowAndLetsGo) {
  test::ShippedReplay replay("gallbladder_bimanual");
  const int gallbladder = replay.organ("gallbladder");
  const auto positions = [&]() -> const Points& {
    return replay.simulator().positions(gallbladder);
  };
  double most = 0.0;
  const auto look = [&](const StepResult& result) {
    for (const InstrumentResult& tool : result.instruments) {
      most = std::max(most, tool.spatial.force.norm());
    }
  };

  const StepResult& step = replay.to(kClosed, look);
  const double top_before = top(positions());
  const double jaws_before = step.instruments[0].X_WC.translation().z();
  EXPECT_GT(step.instruments[0].contacts, 0);
  EXPECT_GT(step.instruments[1].contacts, 0);

  replay.to(kLifted, look);
  const double lift = top(positions()) - top_before;
  const double way = step.instruments[0].X_WC.translation().z() - jaws_before;
  EXPECT_NEAR(way, 0.012, 1e-6);
  EXPECT_GE(lift, 0.8 * way);

  // Held, off the liver: what the tools feel is what the tissue below draws with.
  replay.to(kHeld, look);
  EXPECT_GE(top(positions()) - top_before, 0.8 * way);
  const Vec3 drawn = drawnBack(replay, gallbladder), felt = onTools(step);
  std::printf(
      "lift %.1f of %.1f mm; held with %.4f N, drawn back with %.4f N, most of one %.4f N\n",
      1e3 * lift, 1e3 * way, felt.norm(), drawn.norm(), most);
  EXPECT_LT(felt.z(), 0.0);
  EXPECT_NEAR((felt - drawn).norm(), 0.0, 0.03 * drawn.norm());
  for (const InstrumentResult& tool : step.instruments) {
    EXPECT_LT(tool.spatial.force.z(), 0.25 * drawn.z());  // both carry
  }

  // The jaws squeeze an organ of 4 kPa over less than 4 mm x 15 mm each by less than half.
  replay.to(kLowered, look);
  EXPECT_LT(most, 2.0 * 4e3 * 0.004 * 0.015);

  replay.to(kOpen);
  replay.to(kEnd, [](const StepResult& result) {
    for (const InstrumentResult& tool : result.instruments) {
      EXPECT_EQ(tool.contacts, 0);
      EXPECT_EQ(tool.spatial.force.norm(), 0.0);
    }
  });
  const Points rest = replay.simulator().cells(gallbladder).points;
  EXPECT_LT((positions() - rest).rowwise().mean().norm(), 1e-3);  // back in its bed
}

}  // namespace
}  // namespace palpate::sim::bimanual_scene_test
