// SPDX-License-Identifier: GPL-3.0-or-later
// No force depends on how a scene stands in the world: turned and moved as a whole, organs, tools,
// bone and gravity, it gives the same wrenches in its own axes, whatever the model.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "palpate/formats/trajectory.h"
#include "palpate/io/replay.h"
#include "palpate/sim/simulator.h"
#include "support/source_folder.h"

namespace palpate::sim::turned_scene_test {
namespace {

struct Scene {
  const char* name;
  const char* trajectory;
  double until;  // [s] of it: pressed, and some of the slide
};
void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }

class Turned : public ::testing::TestWithParam<Scene> {};
INSTANTIATE_TEST_SUITE_P(Scenes, Turned,
                         ::testing::Values(Scene{"slab_probe", "slab_probe", 1.7},
                                           Scene{"slab_springs", "slab_probe", 1.7},
                                           Scene{"slab_tensor_mass", "slab_probe", 1.7},
                                           Scene{"slab_hybrid", "slab_probe", 1.7},
                                           Scene{"slab_sampled", "slab_probe", 1.7},
                                           Scene{"slab_bem", "slab_probe", 1.7},
                                           Scene{"slab_enriched", "slab_probe", 1.7},
                                           Scene{"slab_neural", "slab_probe", 1.7},
                                           Scene{"cloth", "cloth", 1.7},
                                           Scene{"honeycomb", "honeycomb", 1.7},
                                           Scene{"interface_2011", "interface_2011", 1.0}),
                         [](const auto& of) { return of.param.name; });

void turn(const Pose& X, scene::PoseConfig* pose) {
  const Pose now = X * pose->pose();
  pose->position = now.translation();
  pose->roll_pitch_yaw = now.linear().eulerAngles(2, 1, 0).reverse();
}

TEST_P(Turned, FeelsTheSameInItsOwnAxes) {
  const Pose X = Eigen::Translation3d(0.3, -0.2, 0.1) *
                 Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, 3.0).normalized());
  const std::string folder = test::sourceFolder() + "/config/";
  const scene::Scene plain = scene::readScene(folder + "scenes/" + GetParam().name + ".yaml");
  scene::Scene turned = plain;
  turned.gravity = X.linear() * plain.gravity;
  for (scene::OrganConfig& organ : turned.organs) turn(X, &organ.pose);
  for (scene::InstrumentConfig& tool : turned.instruments) turn(X, &tool.base);
  for (scene::AnatomyConfig& part : turned.anatomy) turn(X, &part.pose);

  const std::string file = folder + "trajectories/" + GetParam().trajectory + ".csv";
  const formats::Trajectory trajectory = formats::readTrajectory(file);
  Simulator a(plain), b(turned);
  io::Replay replay_a(&a, trajectory, file), replay_b(&b, trajectory, file);
  double peak = 0.0, apart = 0.0, tolerance = 0.0, nodes = 0.0;
  while (replay_a.hasNext() && trajectory.t[replay_a.row()] < GetParam().until) {
    const StepResult& here = replay_a.next();
    const StepResult& there = replay_b.next();
    const Vec3 f = here.instruments[0].solved.force, g = there.instruments[0].solved.force;
    peak = std::max(peak, f.norm());
    apart = std::max(apart, Vec3(X.linear().transpose() * g - f).norm());
    tolerance = std::max({tolerance, here.report.tolerance, there.report.tolerance});
    nodes = std::max(nodes, static_cast<double>(here.report.nodes));
  }
  std::printf("%s: %.3e N apart of %.3f N, tolerance %.1e N\n", GetParam().name, apart, peak,
              tolerance);
  EXPECT_GT(peak, 0.02);
  // Each of both may leave that at each node; the rest is for what is chosen by order, not by size.
  EXPECT_LT(apart, 4.0 * std::sqrt(nodes) * tolerance + 2e-3 * peak);
}

}  // namespace
}  // namespace palpate::sim::turned_scene_test
