// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <string>

#include "palpate/sim/simulator.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"

namespace palpate::sim::graded_scene_test {
namespace {

// The shipped slab, 100 x 100 x 30 mm, under the probe, whose ball of 5 mm touches its top.
class GradedScene : public ::testing::Test {
 protected:
  Simulator simulator(const std::string& element, const std::string& edge_length) const {
    const std::string config = test::sourceFolder() + "/config/";
    return Simulator(scene::readScene(folder_.write("slab.yaml", R"(
gravity: [0, 0, 0]
organs:
  - name: slab
    surface: )" + config + R"(organs/slab.obj
    element: )" + element + R"(
    edge_length: )" + edge_length + R"(
    material: {young_modulus: 6.0e3, poisson_ratio: 0.45, density: 1000}
    supports: [{select: {plane: {axis: z, at: 0, tolerance: 1.0e-4}}}]
instruments:
  - name: probe
    urdf: )" + config + R"(instruments/probe.urdf
    base: {position: [0, 0, 0.035]}
    control_frame: tip
solver: {integrator: static}
)")));
  }

  /// The force where the ball has gone 6 mm down [N].
  static double press(Simulator* simulator) {
    double force = 0.0;
    for (int k = 0; k <= 6; ++k) {
      Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
      q[2] = -1e-3 * k;
      const StepResult& result = simulator->step({simulator->linkPoses(0, q)}, 0.01);
      EXPECT_TRUE(result.report.ok()) << k;
      force = result.instruments[0].spatial.force.z();
    }
    return force;
  }

  test::TempFolder folder_;
};

constexpr char kGraded[] =
    "{coarsest: 0.015, near: [{finest: 0.003, point: [0, 0, 0.03], radius: 0.008, growth: 0.4}]}";

// A mesh that is fine where the ball is has less force than a uniform one of more tetrahedra, and
// quadratic elements on it still less: both come from above.
TEST_F(GradedScene, FeelsLessThanAUniformMeshOfMoreTetrahedra) {
  Simulator uniform = simulator("anp", "0.0085");
  Simulator graded = simulator("anp", kGraded);
  Simulator quadratic = simulator("tet10", kGraded);
  EXPECT_GT(uniform.cells(0).numCells(), graded.cells(0).numCells());
  EXPECT_EQ(quadratic.cells(0).cells.rows(), 10);
  EXPECT_EQ(quadratic.cells(0).numCells(), graded.cells(0).numCells());
  const double of_uniform = press(&uniform), of_graded = press(&graded);
  const double of_quadratic = press(&quadratic);
  EXPECT_GT(of_quadratic, 0.1);
  EXPECT_LT(of_quadratic, of_graded);
  EXPECT_LT(of_graded, 1.25 * of_quadratic);
  EXPECT_GT(of_uniform, 1.25 * of_graded);
}

}  // namespace
}  // namespace palpate::sim::graded_scene_test
