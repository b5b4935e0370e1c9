// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "palpate/sim/simulator.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"

namespace palpate::sim::refused_mesh_test {
namespace {

// A ball that begins 10 mm below the top of the shipped slab: while it is thrown out, the tissue is
// another one than that for which the next mesh was made, 40 ms ago.
class RefusedMesh : public ::testing::TestWithParam<const char*> {
 protected:
  scene::Scene scene() const {
    const std::string config = test::sourceFolder() + "/config/";
    return scene::readScene(folder.write("slab.yaml", R"(
gravity: [0, 0, 0]
organs:
  - name: slab
    surface: )" + config + R"(organs/slab.obj
    edge_length: 0.02
    element: )" + GetParam() + R"(
    adapt: {finest: 0.005}
    material: {law: neo_hookean, young_modulus: 5.0e3, poisson_ratio: 0.48, density: 1000}
    supports: [{select: {plane: {axis: z, at: 0, tolerance: 1.0e-4}}}]
instruments:
  - name: probe
    urdf: )" + config + R"(instruments/probe.urdf
    base: {position: [0, 0, 0.1]}
    control_frame: tip
)"));
  }

  test::TempFolder folder;
};

// On such a mesh elements were inside out and the energy infinite, for ever.
TEST_P(RefusedMesh, IsNotTakenAndAnotherOneComes) {
  Simulator simulator(scene());
  Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
  q[0] = 0.003;
  q[1] = 0.001;
  int changes = 0;
  for (int k = 0; k < 150; ++k) {
    q[2] = k < 40 ? -0.08 : -0.04 - 5e-4 * std::max(0, std::min(k - 80, 60));  // out, and a press
    const StepReport& report = simulator.step({simulator.linkPoses(0, q)}, 0.01).report;
    ASSERT_TRUE(std::isfinite(report.elastic_energy)) << k;
    ASSERT_GT(report.min_jacobian, 0.0) << k;
    ASSERT_TRUE(report.usable()) << k;
    changes += report.mesh_changes;
  }
  EXPECT_GT(changes, 0);
}

INSTANTIATE_TEST_SUITE_P(Elements, RefusedMesh, ::testing::Values("anp", "tet10", "tet10p"));

}  // namespace
}  // namespace palpate::sim::refused_mesh_test
