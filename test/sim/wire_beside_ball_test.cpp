// SPDX-License-Identifier: GPL-3.0-or-later
// A tool so thin that its own points meet the surface, beside a thick one for which the surface
// need not be sampled as closely.
#include <gtest/gtest.h>

#include <cmath>

#include "slab_scene.h"

namespace palpate::sim {
namespace {

using test::SlabScene;

constexpr double kStep = 0.01;
constexpr double kIn = -0.004, kAbove = 0.0015;
constexpr double kLeaves = 0.1;  // so high above the slab nothing touches [m]

// A wire of 0.8 mm across along y, 30 mm beside the probe.
scene::Scene sceneWithWire(const SlabScene& slab) {
  const std::string urdf = slab.folder().write("wire.urdf", R"(<robot name="wire">
<link name="base"/>
<link name="wire"><collision><origin rpy="1.5707963267948966 0 0"/>
  <geometry><cylinder radius="0.0004" length="0.02"/></geometry></collision></link>
<joint name="z" type="prismatic"><parent link="base"/><child link="wire"/><axis xyz="0 0 1"/>
  <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
</robot>)");
  return slab.scene(R"(  - name: wire
    urdf: )" + urdf +
                    R"(
    base: {position: [0.03, 0, 0]}
    control_frame: wire
)");
}

struct Pressed {
  double on_wire = 0.0, on_ball = 0.0;
  int samples = 0;  // of the surface, times tools near it
};

// The wire, that much above the slab or in it [m], and the ball, with half its radius.
Pressed press(const scene::Scene& scene, double wire, bool with_ball) {
  Simulator simulator(scene);
  Pressed end;
  for (int k = 0; k <= 100; ++k) {
    const double down = std::min(1.0, 0.02 * k);
    std::vector<LinkPoses> tools(scene.instruments.size());
    Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
    q[2] = with_ball ? -0.05 - 0.0085 * down : kLeaves;
    tools[0] = simulator.linkPoses(0, q);
    if (tools.size() > 1) {
      tools[1] =
          simulator.linkPoses(1, Eigen::VectorXd::Constant(1, 0.0415 + (wire - 0.0015) * down));
    }
    const StepResult& result = simulator.step(tools, kStep);
    EXPECT_TRUE(result.report.ok()) << k;
    end.on_ball = result.instruments[0].spatial.force.z();
    if (tools.size() > 1) end.on_wire = result.instruments[1].spatial.force.z();
    const auto& skipped = result.report.skipped;
    end.samples = static_cast<int>(skipped.distant_samples + skipped.inactive_samples) +
                  result.report.contacts;
  }
  return end;
}

TEST(WireBesideBall, IsFeltAsWithSamplesThatAreFarCloser) {
  const SlabScene slab;
  scene::Scene scene = sceneWithWire(slab);
  const Pressed own = press(scene, kIn, false);
  scene.contact.sample_spacing = 2e-4;
  const Pressed close = press(scene, kIn, false);
  EXPECT_GT(own.on_wire, 0.05);
  EXPECT_NEAR(own.on_wire, close.on_wire, 0.02 * close.on_wire);
}

TEST(WireBesideBall, MakesTheBallLookAtNoMoreSamples) {
  const SlabScene slab;
  const scene::Scene scene = sceneWithWire(slab);
  scene::Scene alone = scene;
  alone.instruments.resize(1);
  scene::Scene close = scene;
  close.contact.sample_spacing = 5e-4;
  const Pressed a = press(alone, kAbove, true), b = press(scene, kAbove, true),
                c = press(close, kAbove, true);
  EXPECT_NEAR(a.on_ball, b.on_ball, 1e-3 * a.on_ball);
  EXPECT_LT(b.samples, 3 * a.samples);
  EXPECT_GT(c.samples, 4 * b.samples);
}

}  // namespace
}  // namespace palpate::sim
