// SPDX-License-Identifier: GPL-3.0-or-later
// Supports of every kind, from the scene file to the solved organ.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "palpate/formats/vtu_writer.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/sim/simulator.h"
#include "support/contains.h"
#include "support/input_error.h"
#include "support/temp_folder.h"

namespace palpate::sim::organ_supports_test {
namespace {

using test::contains;

// A slab 100 x 100 x 40 mm alone.
class Supports : public ::testing::Test {
 protected:
  Supports() {
    formats::writeVtu(folder_.path("slab.vtu"),
                      mesh::boxMesh(Vec3(0.1, 0.1, 0.04), Eigen::Vector3i(6, 6, 3)), {}, {});
  }
  scene::Scene scene(const std::string& supports, const Vec3& rpy = Vec3::Zero()) const {
    scene::Scene s = scene::readScene(folder_.write("slab.yaml", R"(
organs:
  - name: slab
    tetrahedra: slab.vtu
    material: {law: stable_neo_hookean, young_modulus: 6.0e3, poisson_ratio: 0.45, density: 1060}
    supports: [)" + supports + "]\n"));
    s.organs[0].pose.roll_pitch_yaw = rpy;
    s.gravity = s.organs[0].pose.pose().linear() * s.gravity;
    return s;
  }
  std::string errorOf(const std::string& supports) const {
    return test::complaint([&] { Simulator simulator(scene(supports)); });
  }
  // Displacements in the slab's own frame, after a second.
  static Points displacements(const scene::Scene& scene) {
    Simulator simulator(scene);
    for (int k = 0; k < 100; ++k) EXPECT_TRUE(simulator.step({}, 0.01).report.ok());
    const Points& X = simulator.cells(0).points;
    const Mat3 R = scene.organs[0].pose.pose().linear();
    return R.transpose() * (simulator.positions(0) - X);
  }

  test::TempFolder folder_;
};

constexpr char kBottom[] = "select: {plane: {axis: z, at: 0}}";
constexpr char kSlides[] =
    "{select: {plane: {axis: z, at: 0}}, kind: slide}, "
    "{select: {plane: {axis: x, at: 0}}, kind: slide}, "
    "{select: {plane: {axis: y, at: 0}}, kind: slide}";

// Turned, no plane is across an axis of the world, and springs take the place of the constraint.
// They give way by stress / (1000 E/L), while the slab of height h gives way by stress h/(2 E):
// a part 2 L/(1000 h) = 0.0073 of it, times three where stresses are concentrated.
TEST_F(Supports, SlideOnAnyPlaneAsOnOneAcrossAnAxis) {
  const Points exact = displacements(scene(kSlides));
  const Points turned = displacements(scene(kSlides, Vec3(0.5, 0.4, 0.3)));
  const double largest = exact.colwise().norm().maxCoeff();
  const double difference = (turned - exact).colwise().norm().maxCoeff();
  std::printf("slides: displaced by %.3f mm, by springs %.5f mm off\n", 1e3 * largest,
              1e3 * difference);
  EXPECT_GT(largest, 1e-4);
  EXPECT_LE(difference, 0.022 * largest);
  EXPECT_GT(exact.row(0).maxCoeff(), 0.3 * largest);  // it does slide
}

TEST_F(Supports, SlideAsStiffAsTheyAreTold) {
  const Vec3 rpy(0.5, 0.4, 0.3);
  scene::Scene soft = scene(kSlides, rpy);
  for (scene::SupportConfig& support : soft.organs[0].supports) support.stiffness = 2.0e5;
  const double weight = 0.1 * 0.1 * 0.04 * 1060.0 * 9.81;
  Simulator simulator(soft);
  const Points u = soft.organs[0].pose.pose().linear().transpose() *
                   (simulator.positions(0) - simulator.cells(0).points);
  // In the mean of the bottom, about, as its points at the rim have less area.
  const Points X =
      soft.organs[0].pose.pose().inverse() * simulator.cells(0).points.colwise().homogeneous();
  double sum = 0.0;
  int count = 0;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    if (std::abs(X(2, i)) < 1e-9) sum += u(2, i), ++count;
  }
  EXPECT_NEAR(sum / count, -weight / (2.0e5 * 0.01), 0.1 * weight / (2.0e5 * 0.01));
}

TEST_F(Supports, MoveAsATableSays) {
  folder_.write("way.csv", "t,x,y,z\n0,0,0,0.001\n0.2,0,0,0.003\n0.5,0.002,0,0.006\n");
  const std::string motion = std::string("{") + kBottom + ", motion: {file: way.csv}}";
  Simulator simulator(scene(motion));
  const auto nodes = static_cast<double>(simulator.positions(0).cols());
  for (int k = 0; k < 100; ++k) {
    const StepResult& result = simulator.step({}, 0.01);
    ASSERT_TRUE(result.report.ok());
    // The sum of n forces whose norm is the residual.
    EXPECT_LE(result.report.imbalance, std::sqrt(nodes) * result.report.residual + 1e-12);
    EXPECT_EQ(result.report.skipped.sleeping_organs, 0);
  }
  const Points& X = simulator.cells(0).points;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    if (X(2, i) > 0.0) continue;
    EXPECT_LT((simulator.positions(0).col(i) - X.col(i) - Vec3(0.002, 0.0, 0.005)).norm(), 1e-12);
  }
}

TEST_F(Supports, MoveInTheOrgansOwnFrame) {
  const std::string motion =
      std::string("{") + kBottom + ", motion: {amplitude: [0.001, 0, 0], period: 0.4}}";
  const scene::Scene turned = scene(motion, Vec3(0.0, 0.0, M_PI / 2));
  const Points u = displacements(turned);  // after 2.5 periods
  Simulator simulator(turned);
  for (int k = 0; k < 50; ++k) simulator.step({}, 0.01);  // sin(2 pi 1.25) = 1
  const Points way = simulator.positions(0) - simulator.cells(0).points;
  EXPECT_NEAR(way(1, 0), 0.001, 1e-12);
  EXPECT_NEAR(way(0, 0), 0.0, 1e-12);
  EXPECT_LT(u.col(0).norm(), 1e-12);
}

TEST_F(Supports, SayWhatIsWrong) {
  EXPECT_TRUE(contains(errorOf("{select: {box: {min: [0.09, 0.09, 0.03], max: [0.2, 0.2, 0.2]}}, "
                               "kind: springs, normal: 1e5}"),
                       "organs[0].supports[0].select: must select a face of the organ's surface, "
                       "with all its corners; it selects 1 nodes and no such face"));
  EXPECT_TRUE(contains(errorOf("{select: {sphere: {center: [1, 1, 1], radius: 0.1}}, kind: slide}"),
                       "organs[0].supports[0].select: must select at least one node"));
  const std::string bottom = kBottom;
  EXPECT_TRUE(contains(errorOf("{" + bottom + ", kind: rope}"), "supports[0].kind = rope"));
  EXPECT_TRUE(contains(errorOf("{" + bottom + ", kind: springs}"),
                       "springs need at least one of normal, tangential"));
  EXPECT_TRUE(contains(errorOf("{" + bottom + ", kind: slide, motion: {amplitude: [1, 0, 0]}}"),
                       "organs[0].supports[0].motion"));
  EXPECT_TRUE(contains(errorOf("{" + bottom + ", motion: {period: 1}}"),
                       "supports[0].motion: needs exactly one of amplitude, file"));
  EXPECT_TRUE(contains(errorOf("{" + bottom + ", motion: {file: no.csv}}"), "no.csv"));
  folder_.write("joints.csv", "t,a,b\n0,0,0\n1,0,0\n");
  EXPECT_TRUE(contains(errorOf("{" + bottom + ", motion: {file: joints.csv}}"),
                       "the first row must be t,x,y,z"));
  folder_.write("late.csv", "t,x,y,z\n1,0,0,0\n2,0,0,0\n");
  EXPECT_TRUE(
      contains(errorOf("{" + bottom + ", motion: {file: late.csv}}"), "must begin at t = 0"));
  folder_.write("open.csv", "t,x,y,z\n0,0,0,0\n2,1,0,0\n");
  EXPECT_TRUE(contains(errorOf("{" + bottom + ", motion: {file: open.csv, periodic: true}}"),
                       "must end where it begins to be periodic"));
  // Springs along the normal alone leave the slab to slide away.
  EXPECT_TRUE(
      contains(errorOf("{" + bottom + ", kind: springs, normal: 1e5}"), "translation along x"));
}

}  // namespace
}  // namespace palpate::sim::organ_supports_test
