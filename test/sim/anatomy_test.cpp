// SPDX-License-Identifier: GPL-3.0-or-later
// Fixed anatomy: organs rest on it, and tools feel it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>
#include <vector>

#include "anatomy_scene.h"
#include "palpate/tissue/method_facts.h"
#include "support/contains.h"
#include "support/input_error.h"

namespace palpate::sim::anatomy_test {
namespace {

using test::AnatomyScene;

Eigen::VectorXd at(double x, double y, double z) {
  Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
  q.head<3>() << x, y, z;
  return q;
}

class Anatomy : public ::testing::Test {
 protected:
  const StepResult& step(Simulator* simulator, const Eigen::VectorXd& q) {
    return simulator->step({simulator->linkPoses(0, q)}, 0.01);
  }
  // See TissueModel: what is left unbalanced on each node is within the tolerance.
  static void expectBalance(const Simulator& simulator, const StepReport& report) {
    const auto nodes = static_cast<double>(simulator.positions(0).size());
    EXPECT_LE(report.imbalance, std::sqrt(nodes) * report.tolerance + 1e-9);
  }
  static Vec3 onAnatomy(const StepResult& result) {
    Vec3 sum = Vec3::Zero();
    for (const ContactPoint& c : result.contacts) {
      if (c.anatomy != ContactPoint::kNone && c.organ != ContactPoint::kNone) sum += c.force_W;
    }
    return sum;
  }

  AnatomyScene files;
};

// Far from the slab; the probe's base is at z = 0.1 and its ball of 5 mm there at joints zero.
TEST_F(Anatomy, ABallOnAPlateFeelsItsStiffnessAndTheTorqueAboutItsControlFrame) {
  scene::Scene scene = files.scene(AnatomyScene::bone("plate.obj", "[0.5, 0, 0.05]"));
  scene.instruments[0].control_frame = "base";
  scene.anatomy[0].felt_stiffness = 1.5e4;
  Simulator simulator(scene);
  EXPECT_EQ(simulator.numAnatomy(), 1);
  for (const double depth : {-1e-6, 1e-6, 1e-3}) {
    const StepResult& result = step(&simulator, at(0.48, 0.01, -0.045 - depth));
    const InstrumentResult& tool = result.instruments[0];
    const Vec3 force(0.0, 0.0, 1.5e4 * std::max(depth, 0.0));
    EXPECT_LT((tool.spatial.force - force).norm(), 1e-8);
    // The plate touches the ball at its own surface or, in it, where it is deepest.
    const Vec3 arm = Vec3(0.48, 0.01, 0.05) - Vec3(0.0, 0.0, 0.1);
    EXPECT_LT((tool.spatial.torque - arm.cross(force)).norm(), 1e-8);
    EXPECT_EQ(tool.contacts, depth > 0.0 ? 1 : 0);
    EXPECT_EQ(result.report.contacts, tool.contacts);
    EXPECT_EQ(tool.max_penetration, 0.0);  // of tissue
    ASSERT_EQ(result.contacts.size(), static_cast<std::size_t>(tool.contacts));
    if (depth <= 0.0) continue;
    EXPECT_EQ(result.contacts[0].instrument, 0);
    EXPECT_EQ(result.contacts[0].anatomy, 0);
    EXPECT_EQ(result.contacts[0].organ, ContactPoint::kNone);
    EXPECT_LT((result.contacts[0].p_W - Vec3(0.48, 0.01, 0.05 - depth)).norm(), 1e-9);
    EXPECT_TRUE(tool.live);
  }
}

TEST_F(Anatomy, OfAnyShapeIsFeltAsItIs) {
  // Five times 20 mm, 4 mm thick: through the opening of the hook, and on its top.
  const scene::Scene scene = files.scene(AnatomyScene::bone("hook.obj", "[0.5, 0, 0.1]"));
  Simulator simulator(scene);
  ASSERT_EQ(simulator.notes().size(), 1u);
  EXPECT_TRUE(test::contains(simulator.notes()[0], "anatomy bone: not convex"));
  const Vec3 opening(0.55, 0.01, 0.13), top(0.55, 0.01, 0.2 + 0.0045);
  const auto joints = [](const Vec3& p) { return at(p.x(), p.y(), p.z() - 0.1); };
  EXPECT_TRUE(simulator.isFree(0, simulator.linkPoses(0, joints(Vec3(0.55, 0.01, 0.3)))));
  EXPECT_FALSE(simulator.isFree(0, simulator.linkPoses(0, joints(top))));
  const StepResult& on_top = step(&simulator, joints(top));
  const double k = scene.anatomy[0].felt_stiffness;
  EXPECT_NEAR(on_top.instruments[0].spatial.force.z(), 0.5e-3 * k, 1e-4 * k);
  EXPECT_LT(on_top.instruments[0].spatial.force.head<2>().norm(), 0.05 * 0.5e-3 * k);
  // The shaft goes through the top of the hook there; the ball does not touch.
  const StepResult& inside = step(&simulator, joints(opening));
  for (const ContactPoint& c : inside.contacts) EXPECT_GT(c.p_W.z(), 0.17);
}

TEST_F(Anatomy, AnOrganIsSqueezedBetweenToolAndBone) {
  scene::Scene scene =
      files.scene("gravity: [0, 0, 0]\n" + AnatomyScene::bone("plate.obj", "[0, 0, -0.0005]"));
  scene.organs[0].supports[0].select = mesh::PlaneRegion{0, 0.0, 1e-6};  // the side x = 0
  Simulator simulator(scene);
  double force = 0.0, bone = 0.0;
  int balanced = 0;
  for (int k = 0; k <= 200; ++k) {
    const StepResult& result =
        step(&simulator, at(0.01, 0.0, std::max(-0.05 - 0.0002 * k, -0.065)));
    ASSERT_TRUE(result.report.ok()) << k;
    expectBalance(simulator, result.report);
    force = result.instruments[0].spatial.force.z();
    bone = -onAnatomy(result).z();
    balanced += result.report.imbalance < 1e-2 * force;
    for (const ContactPoint& c : result.contacts) EXPECT_EQ(c.organ, 0);
  }
  EXPECT_GT(force, 0.3);
  // A slab that is held by one side is carried by the bone below the tool, not by that side.
  EXPECT_GT(bone, 0.7 * force);
  EXPECT_GT(balanced, 100);
  // It may go in by the penalty only, some 1e-4 m.
  EXPECT_GT(simulator.positions(0).row(2).minCoeff(), -0.0007);
  std::cout << "tool " << force << " N, bone " << bone << " N\n";
}

// Some solve for positions, some prescribe them, and one knows small strains only.
TEST_F(Anatomy, EveryMethodPressesAnOrganOnBone) {
  for (const std::string& method : tissue::methodNames()) {
    scene::Scene scene =
        files.scene("gravity: [0, 0, 0]\n" + AnatomyScene::bone("plate.obj", "[0, 0, -0.0005]"));
    scene.organs[0].supports[0].select = mesh::PlaneRegion{0, 0.0, 1e-6};
    scene.solver.method = method;
    Simulator simulator(scene);
    double force = 0.0, bone = 0.0;
    for (int k = 0; k <= 20; ++k) {
      const StepResult& result =
          step(&simulator, at(0.01, 0.0, std::max(-0.05 - 0.001 * k, -0.060)));
      ASSERT_TRUE(result.report.usable()) << method << " " << k;
      force = result.instruments[0].spatial.force.z();
      bone = -onAnatomy(result).z();
    }
    EXPECT_GT(force, 0.05) << method;
    EXPECT_GT(bone, 0.5 * force) << method;
    EXPECT_GT(simulator.positions(0).row(2).minCoeff(), -0.001) << method;
    std::cout << method << ": tool " << force << " N, bone " << bone << " N\n";
  }
}

// A stiff slab that is held by one side, half a millimetre above a plate, under its own weight of
// 4.16 N: it settles some millimetres deep in the plate, is pushed out and comes to rest on it.
TEST_F(Anatomy, ASlabRestsOnAPlateAndSleeps) {
  scene::Scene scene = files.scene(AnatomyScene::bone("plate.obj", "[0, 0, -0.0005]"));
  scene.organs[0].supports[0].select = mesh::PlaneRegion{0, 0.0, 1e-6};
  scene.organs[0].material.constants["young_modulus"] = {3.0e5};
  scene.organs[0].damping.mass = 20.0;
  Simulator simulator(scene);
  ASSERT_EQ(simulator.warnings().size(), 1u);
  EXPECT_TRUE(test::contains(simulator.warnings()[0], "organ slab begins"));
  EXPECT_TRUE(test::contains(simulator.warnings()[0], "mm deep in anatomy bone"));
  Vec3 bone = Vec3::Zero();
  long slept = 0;
  for (int k = 0; k < 600; ++k) {
    const StepResult& result = simulator.step({LinkPoses()}, 0.01);
    ASSERT_TRUE(result.report.ok()) << k;
    expectBalance(simulator, result.report);
    bone = onAnatomy(result);
    slept += result.report.skipped.sleeping_organs;
  }
  // A beam with one end clamped leaves 3/8 of its weight to a prop at the other one, less
  // 3 E I / L^3 times what the prop is lower; and here the plate begins before the end.
  const double inertia = 0.1 * std::pow(0.04, 3) / 12.0;
  EXPECT_LT(bone.z(), -3.0 / 8.0 * 4.16 + 3.0 * 3.0e5 * inertia / 1e-3 * 0.5e-3);
  EXPECT_GT(bone.z(), -4.16);
  EXPECT_LT(bone.head<2>().norm(), 0.05 * bone.norm());
  EXPECT_GT(simulator.positions(0).row(2).minCoeff(), -0.0008);
  EXPECT_GT(slept, 0);
  std::cout << "bone carries " << bone.z() << " N of 4.16 N; slept " << slept << " cycles\n";
  // A tool wakes it.
  for (int k = 0; k < 30; ++k) {
    const StepResult& result = step(&simulator, at(0.01, 0.0, -0.05 - 0.0005 * k));
    slept = result.report.skipped.sleeping_organs;
    expectBalance(simulator, result.report);
  }
  EXPECT_EQ(slept, 0);
}

TEST_F(Anatomy, FarBoneIsSkipped) {
  const auto skipped = [&](const std::string& bone) {
    Simulator simulator(files.scene(bone));
    return step(&simulator, at(0.0, 0.0, -0.05)).report.skipped.far_bodies;
  };
  const auto none = skipped("");
  EXPECT_EQ(skipped(AnatomyScene::bone("plate.obj", "[0.5, 0, 0]")), none + 1);
  EXPECT_EQ(skipped(AnatomyScene::bone("plate.obj", "[0, 0, -0.0005]")), none);
  // Around the slab, within half a metre: the slab is in the opening, 300 mm wide.
  EXPECT_EQ(skipped(AnatomyScene::bone("hook.obj", "[-0.25, -0.05, -0.2]", ", scale: 5")),
            none + 1);
}

// A thin tool asks for many points of the surface; what is thick does not feel more of them.
TEST_F(Anatomy, FeelsTheSameBesideAThinTool) {
  const auto rests = [&](double radius) {
    scene::Scene scene = files.scene(AnatomyScene::bone("plate.obj", "[0, 0, -0.0005]"));
    scene.organs[0].supports[0].select = mesh::PlaneRegion{0, 0.0, 1e-6};
    std::ostringstream urdf;
    urdf << "<robot name='rod'><link name='tip'><collision><geometry><cylinder radius='" << radius
         << "' length='0.1'/></geometry></collision></link></robot>";
    scene.instruments[0].urdf = files.folder().write("rod.urdf", urdf.str());
    scene.instruments[0].base.position = Vec3(0.0, 0.0, 0.5);
    scene.organs[0].damping.mass = 20.0;
    Simulator simulator(scene);
    std::vector<Vec3> forces;
    for (int k = 0; k < 20; ++k) {
      forces.push_back(onAnatomy(simulator.step({LinkPoses()}, 0.01)));
    }
    return forces;
  };
  const std::vector<Vec3> thick = rests(0.01), thin = rests(0.001);
  double most = 0.0;
  for (const Vec3& force : thick) most = std::max(most, force.norm());
  EXPECT_GT(most, 1.0);
  EXPECT_EQ(thick, thin);
  std::cout << "bone carries up to " << most << " N\n";
}

TEST_F(Anatomy, AProxiedToolWaitsOutside) {
  scene::Scene scene = files.scene(AnatomyScene::bone("plate.obj", "[0.5, 0, 0.05]"));
  scene.instruments[0].proxy.active = true;
  Simulator simulator(scene);
  EXPECT_TRUE(step(&simulator, at(0.5, 0.0, -0.046)).instruments[0].waiting);
  EXPECT_FALSE(step(&simulator, at(0.5, 0.0, -0.044)).instruments[0].waiting);
}

TEST_F(Anatomy, GoesOnFromASavedStateToTheSameBits) {
  scene::Scene scene =
      files.scene("gravity: [0, 0, 0]\n" + AnatomyScene::bone("plate.obj", "[0, 0, -0.0005]"));
  scene.organs[0].supports[0].select = mesh::PlaneRegion{0, 0.0, 1e-6};
  Simulator whole(scene), other(scene);
  const auto z = [](int k) { return std::max(-0.05 - 0.0005 * k, -0.065); };
  for (int k = 0; k < 30; ++k) step(&whole, at(0.01, 0.0, z(k)));
  other.restore(whole.state());
  for (int k = 30; k < 50; ++k) {
    const StepResult& a = step(&whole, at(0.01, 0.0, z(k)));
    const StepResult& b = step(&other, at(0.01, 0.0, z(k)));
    ASSERT_EQ(a.instruments[0].spatial.force, b.instruments[0].spatial.force);
    ASSERT_EQ(whole.positions(0), other.positions(0));
    ASSERT_EQ(a.contacts.size(), b.contacts.size());
  }
}

class AnatomyErrors : public Anatomy {
 protected:
  std::vector<Problem> problems(const std::string& text) {
    return test::problemsOf([&] { Simulator simulator(files.scene(text)); });
  }
};

TEST_F(AnatomyErrors, SayWhatIsWrong) {
  using test::hasProblem;
  EXPECT_TRUE(hasProblem(problems(AnatomyScene::bone("none.obj", "[0, 0, 0]")), "", "none.obj") ||
              !problems(AnatomyScene::bone("none.obj", "[0, 0, 0]")).empty());
  EXPECT_TRUE(hasProblem(problems("anatomy: [{surface: plate.obj}]\n"), "anatomy[0].name", ""));
  EXPECT_TRUE(hasProblem(problems("anatomy: [{name: a}]\n"), "anatomy[0].surface", ""));
  EXPECT_TRUE(hasProblem(
      problems("anatomy: [{name: a, surface: plate.obj}, {name: a, surface: plate.obj}]\n"),
      "anatomy[1].name", ""));
  EXPECT_TRUE(
      hasProblem(problems(AnatomyScene::bone("plate.obj", "[0, 0, 0]", ", stiffness: 1.0e9")),
                 "anatomy[0].stiffness", ""));
  EXPECT_TRUE(
      hasProblem(problems(AnatomyScene::bone("plate.obj", "[0, 0, 0]", ", shape: {cells: 2}")),
                 "anatomy[0].shape.cells", ""));
  EXPECT_TRUE(hasProblem(problems(AnatomyScene::bone("plate.obj", "[0, 0, 0]", ", mass: 2")),
                         "anatomy[0].mass", ""));
  mesh::SurfaceMesh open = test::uSurface();
  open.triangles.conservativeResize(3, open.triangles.cols() - 6);
  files.folder().write("open.obj", test::objText(open));
  EXPECT_TRUE(hasProblem(problems(AnatomyScene::bone("open.obj", "[0, 0, 0]")),
                         "anatomy[0].surface", "the surface is open"));
  EXPECT_TRUE(hasProblem(problems(AnatomyScene::bone("plate.obj", "[0, 0, 0]", ", scale: 1.0e5")),
                         "anatomy[0].scale", ""));
}

}  // namespace
}  // namespace palpate::sim::anatomy_test
