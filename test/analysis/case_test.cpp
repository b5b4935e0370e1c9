// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/analysis/case.h"

#include <gtest/gtest.h>

#include "palpate/tissue/fem/fem_tissue.h"

#include "palpate/material/material.h"
#include "palpate/scene/scene.h"
#include "support/input_error.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"

namespace palpate::analysis::case_test {
namespace {

using test::hasProblem;

constexpr char kStatic[] = R"(mesh: {file: bar.msh}
element: tet4
material: {law: neo_hookean, mu: 1.0e4, kappa: 1.0e5, density: 1000.0}
boundary:
  - {select: {plane: {axis: z, at: 0.0}}, displacement: [0, 0, 0]}
  - {select: {box: {min: [-1, -1, 0.99], max: [1, 1, 1.01]}}, rotation: {axis: [0, 0, 1], origin: [0.05, 0.05, 1.0], angle: 1.57}, displacement: [0, null, 0.1]}
  - {select: {sphere: {center: [0, 0, 0.5], radius: 0.01}}, traction: [0, 0, -100.0]}
  - {select: {plane: {axis: x, at: 0.1, tolerance: 0.001}}, pressure: 100.0}
gravity: [0, 0, -9.81]
analysis: {kind: static, load_steps: 20, tolerance: 1.0e-9}
probes:
  - {name: mid, point: [0, 0, 0.5]}
  - {name: support, select: {plane: {axis: z, at: 0.0}}, quantity: reaction}
)";

constexpr char kDynamic[] = R"(mesh: {box: {size: [0.1, 0.1, 1.0], cells: [4, 4, 40]}, scale: 0.5}
material: {young_modulus: 1.0e4, poisson_ratio: 0.3}
analysis: {kind: dynamic, integrator: backward_euler, method: implicit_direct, dt: 0.02,
           duration: 1.5, tolerance: 1.0e-5, max_newton_iterations: 9, linear_tolerance: 0.1}
)";

class CaseFile : public ::testing::Test {
 protected:
  Case read(const std::string& text) const { return readCase(folder_.write("case.yaml", text)); }

  std::vector<Problem> problemsWith(std::string text, const std::string& from,
                                    const std::string& to) const {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    return test::problemsOf([&] { read(text); });
  }

  test::TempFolder folder_;
};

TEST_F(CaseFile, Static) {
  const Case c = read(kStatic);
  EXPECT_EQ(c.file, folder_.path("case.yaml"));
  EXPECT_EQ(c.mesh.file, "bar.msh");
  EXPECT_FALSE(c.mesh.box);
  EXPECT_EQ(c.mesh.scale, 1.0);
  EXPECT_EQ(c.element, "tet4");
  EXPECT_EQ(c.material.density, 1000.0);
  EXPECT_EQ(material::moduli(material::makeMaterial(c.material.law, c.material.constants)).mu, 1e4);
  EXPECT_EQ(c.gravity, Vec3(0, 0, -9.81));
  const auto& analysis = std::get<StaticAnalysis>(c.analysis);
  EXPECT_EQ(analysis.load_steps, 20);
  EXPECT_EQ(analysis.tolerance, 1e-9);

  ASSERT_EQ(c.boundary.size(), 4u);
  const BoundaryCondition& clamp = c.boundary[0];
  EXPECT_TRUE(std::holds_alternative<mesh::PlaneRegion>(clamp.select));
  EXPECT_EQ(clamp.displacement.value(), (keys::PartialVec3{0.0, 0.0, 0.0}));
  EXPECT_FALSE(clamp.rotation || clamp.traction || clamp.pressure);
  const BoundaryCondition& turn = c.boundary[1];
  EXPECT_EQ(std::get<mesh::BoxRegion>(turn.select).min, Vec3(-1, -1, 0.99));
  EXPECT_EQ(turn.displacement.value(), (keys::PartialVec3{0.0, std::nullopt, 0.1}));
  EXPECT_EQ(turn.rotation.value().axis, Vec3(0, 0, 1));
  EXPECT_EQ(turn.rotation.value().origin, Vec3(0.05, 0.05, 1.0));
  EXPECT_EQ(turn.rotation.value().angle, 1.57);
  EXPECT_TRUE(turn.holds());
  EXPECT_EQ(c.boundary[2].traction.value(), Vec3(0, 0, -100));
  EXPECT_FALSE(c.boundary[2].holds());
  EXPECT_EQ(c.boundary[3].pressure.value(), 100.0);

  ASSERT_EQ(c.probes.size(), 2u);
  EXPECT_EQ(c.probes[0].name, "mid");
  EXPECT_EQ(c.probes[0].point.value(), Vec3(0, 0, 0.5));
  EXPECT_FALSE(c.probes[0].select);
  EXPECT_TRUE(c.probes[1].select);
  EXPECT_EQ(c.probes[1].quantity, "reaction");
}

TEST_F(CaseFile, Dynamic) {
  const Case c = read(kDynamic);
  EXPECT_EQ(c.mesh.box.value().size, Vec3(0.1, 0.1, 1.0));
  EXPECT_EQ(c.mesh.box.value().cells, Eigen::Vector3i(4, 4, 40));
  EXPECT_EQ(c.mesh.scale, 0.5);
  const auto& analysis = std::get<DynamicAnalysis>(c.analysis);
  EXPECT_EQ(analysis.integrator, "backward_euler");
  EXPECT_EQ(analysis.method, "implicit_direct");
  EXPECT_EQ(analysis.dt, 0.02);
  EXPECT_EQ(analysis.duration, 1.5);
  EXPECT_EQ(analysis.tolerance, 1e-5);
  EXPECT_EQ(analysis.max_newton_iterations, 9);
  EXPECT_EQ(analysis.linear_tolerance, 0.1);
}

TEST_F(CaseFile, DefaultsAreTheScenes) {
  const scene::SolverConfig scene;
  const DynamicAnalysis analysis;
  EXPECT_EQ(analysis.dt, scene.step);
  EXPECT_EQ(analysis.tolerance, scene.tolerance);
  EXPECT_EQ(analysis.max_newton_iterations, scene.max_newton_iterations);
  EXPECT_EQ(analysis.linear_tolerance, scene.linear_tolerance);
  EXPECT_EQ(analysis.integrator, solver::integratorNames().at(0));
  EXPECT_EQ(analysis.method, tissue::methodNames().at(0));
}

TEST_F(CaseFile, Mesh) {
  EXPECT_TRUE(hasProblem(problemsWith(kStatic, "{file: bar.msh}", "{}"), "mesh", "file, box"));
  EXPECT_TRUE(hasProblem(problemsWith(kDynamic, "mesh: {", "mesh: {file: a.msh, "), "mesh",
                         "exactly one of file, box"));
  EXPECT_TRUE(hasProblem(problemsWith(kDynamic, "[4, 4, 40]", "[4, 0, 40]"), "mesh.box.cells",
                         "whole numbers"));
  EXPECT_TRUE(hasProblem(problemsWith(kDynamic, "[4, 4, 40]", "[999, 999, 999]"), "mesh.box.cells",
                         "2 million"));
  EXPECT_TRUE(hasProblem(problemsWith(kDynamic, "[0.1, 0.1, 1.0]", "[0.1, -0.1, 1.0]"),
                         "mesh.box.size", "in (0"));
}

TEST_F(CaseFile, Boundary) {
  EXPECT_TRUE(hasProblem(problemsWith(kStatic, ", pressure: 100.0", ""), "boundary[3]",
                         "at least one of displacement"));
  EXPECT_TRUE(hasProblem(problemsWith(kStatic, "axis: [0, 0, 1]", "axis: [0, 0, 0]"),
                         "boundary[1].rotation.axis", "not be zero"));
  EXPECT_TRUE(hasProblem(problemsWith(kStatic, "[0, null, 0.1]", "[0, .nan, 0.1]"),
                         "boundary[1].displacement", "or null"));
  EXPECT_TRUE(hasProblem(problemsWith(kStatic, "[0, null, 0.1]", "[0, 0.1]"),
                         "boundary[1].displacement", "list of three"));
  EXPECT_TRUE(hasProblem(problemsWith(kStatic, "pressure: 100.0", "pressure: .inf"),
                         "boundary[3].pressure", "finite [Pa]"));
  EXPECT_TRUE(hasProblem(problemsWith(kStatic,
                                      "select: {plane: {axis: x, at: 0.1, tolerance: "
                                      "0.001}}, ",
                                      ""),
                         "boundary[3].select", "is missing"));
}

TEST_F(CaseFile, StaticNeedsAHold) {
  const std::string text =
      "mesh: {file: bar.msh}\nmaterial: {mu: 1.0, kappa: 1.0}\n"
      "boundary: [{select: {plane: {axis: z, at: 0}}, traction: [0, 0, 1]}]\n"
      "analysis: {kind: static}\n";
  EXPECT_TRUE(hasProblem(test::problemsOf([&] { read(text); }), "boundary", "static case needs"));
}

TEST_F(CaseFile, Analysis) {
  EXPECT_TRUE(
      hasProblem(problemsWith(kDynamic, "duration: 1.5, ", ""), "analysis.duration", "is missing"));
  EXPECT_TRUE(hasProblem(problemsWith(kDynamic, "duration: 1.5", "duration: 1.0e6"),
                         "analysis.duration", "10 million"));
  EXPECT_TRUE(hasProblem(problemsWith(kDynamic, "backward_euler", "bdf3"), "analysis.integrator",
                         "must be one of backward_euler, bdf2, static"));
  EXPECT_TRUE(hasProblem(problemsWith(kDynamic, "implicit_direct", "implicit_pgc"),
                         "analysis.method", "did you mean implicit_pcg?"));
  EXPECT_TRUE(hasProblem(problemsWith(kStatic, "load_steps: 20", "load_steps: 0"),
                         "analysis.load_steps", "whole number in [1"));
  EXPECT_TRUE(hasProblem(problemsWith(kStatic, "load_steps: 20", "dt: 0.1"), "analysis.dt",
                         "only with kind: dynamic"));
  EXPECT_TRUE(
      hasProblem(problemsWith(kStatic, "kind: static, ", ""), "analysis.kind", "is missing"));
}

TEST_F(CaseFile, Probes) {
  EXPECT_TRUE(hasProblem(problemsWith(kStatic, "point: [0, 0, 0.5]", "quantity: reaction"),
                         "probes[0]", "either point, or select and quantity"));
  EXPECT_TRUE(hasProblem(problemsWith(kStatic, ", quantity: reaction", ""), "probes[1]",
                         "either point, or select and quantity"));
  EXPECT_TRUE(hasProblem(problemsWith(kStatic, "name: mid", "name: support"), "probes[1].name",
                         "must differ"));
  EXPECT_TRUE(hasProblem(problemsWith(kStatic, "name: mid", "name: \"a,b\""), "probes[0].name",
                         "must be a name"));
}

TEST_F(CaseFile, ElementAndMaterial) {
  EXPECT_TRUE(hasProblem(problemsWith(kStatic, "tet4", "tet44"), "element", "did you mean tet4?"));
  EXPECT_TRUE(
      hasProblem(problemsWith(kStatic, "kappa: 1.0e5", "kappa: -1"), "material.kappa", "> 0"));
  EXPECT_TRUE(hasProblem(problemsWith(kStatic, "gravity", "gravitty"), "gravitty",
                         "did you mean gravity?"));
}

TEST(CaseFormat, CommittedPageIsTheGeneratedOne) {
  const std::string page = test::sourceFolder() + "/docs/case_format.md";
  EXPECT_EQ(test::fileBytes(page), caseFormatMarkdown())
      << "regenerate: palpate docs case_format > docs/case_format.md";
}

}  // namespace
}  // namespace palpate::analysis::case_test
