// SPDX-License-Identifier: GPL-3.0-or-later
// Materials, regions, fibres and damping as scene and case files say them.
#include <gtest/gtest.h>

#include "palpate/analysis/case.h"
#include "palpate/scene/scene.h"
#include "support/input_error.h"
#include "support/temp_folder.h"

namespace palpate::scene::body_fields_test {
namespace {

using test::hasProblem;

constexpr char kBody[] = R"(material: {law: neo_hookean, mu: 1.0e3, kappa: 1.0e4,
             viscoelastic: [{g: 0.45, tau: 0.5}, {g: 0.365, tau: 50}]}
fibres: {direction: [0, 0, 1], sheet: [1, 0, 0]}
regions:
  - name: capsule
    select: {depth: {max: 0.001}}
    material: {file: ../materials/liver_capsule.yaml}
  - name: core
    select: {depth: {min: 0.01, max: 0.02}}
    fibres: {field: fibre_directions, sheet_field: sheet_directions}
  - {name: tumour, select: {cell_data: {name: tissue, value: 3}}, material: {mu: 5.0e4, kappa: 1.0e5}}
  - {name: group, select: {cell_data: {value: -2}}, material: {mu: 5.0e4, kappa: 1.0e5}}
  - {name: ball, select: {sphere: {center: [1, 2, 3], radius: 4}}, material: {mu: 1.0, kappa: 1.0}}
  - {name: cube, select: {box: {min: [0, 0, 0], max: [1, 1, 1]}}, material: {mu: 1.0, kappa: 1.0}}
  - {name: upper, select: {half_space: {point: [0, 0, 1], normal: [0, 0, 2]}}, material: {mu: 1.0, kappa: 1.0}}
)";

std::string indented(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    out += "    " + text.substr(at, end + 1 - at);
    at = end + 1;
  }
  return out;
}

void expectBody(const BodyConfig& body) {
  EXPECT_EQ(body.material.law, "neo_hookean");
  ASSERT_EQ(body.material.viscoelastic.size(), 2u);
  EXPECT_EQ(body.material.viscoelastic[0].g, 0.45);
  EXPECT_EQ(body.material.viscoelastic[1].tau, 50.0);
  EXPECT_EQ(body.fibres.value().direction.value(), Vec3::UnitZ());
  EXPECT_EQ(body.fibres->sheet.value(), Vec3::UnitX());
  ASSERT_EQ(body.regions.size(), 7u);
  const auto& regions = body.regions;
  EXPECT_EQ(regions[0].name, "capsule");
  EXPECT_EQ(std::get<mesh::DepthRegion>(regions[0].select).max, 0.001);
  EXPECT_EQ(regions[0].material.value().file, "../materials/liver_capsule.yaml");
  EXPECT_FALSE(regions[0].fibres);
  EXPECT_EQ(std::get<mesh::DepthRegion>(regions[1].select).min, 0.01);
  EXPECT_FALSE(regions[1].material);
  EXPECT_EQ(regions[1].fibres.value().field, "fibre_directions");
  EXPECT_EQ(regions[1].fibres->sheet_field, "sheet_directions");
  EXPECT_EQ(std::get<mesh::CellDataRegion>(regions[2].select).name, "tissue");
  EXPECT_EQ(std::get<mesh::CellDataRegion>(regions[2].select).value, 3);
  EXPECT_EQ(std::get<mesh::CellDataRegion>(regions[3].select).name, "");
  EXPECT_EQ(std::get<mesh::CellDataRegion>(regions[3].select).value, -2);
  EXPECT_EQ(std::get<mesh::SphereRegion>(regions[4].select).radius, 4.0);
  EXPECT_EQ(std::get<mesh::BoxRegion>(regions[5].select).max, Vec3(1, 1, 1));
  EXPECT_EQ(std::get<mesh::HalfSpaceRegion>(regions[6].select).normal, Vec3(0, 0, 2));
}

class BodyFields : public ::testing::Test {
 protected:
  Scene scene(const std::string& body) const {
    return readScene(
        folder_.write("scene.yaml", "organs:\n  - name: a\n    surface: a.obj\n" + indented(body)));
  }
  /// Of the good body with `from` turned into `to`; keys from the organ on.
  std::vector<Problem> problemsWith(const std::string& from, const std::string& to) const {
    std::string text = kBody;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    std::vector<Problem> problems =
        test::problemsOf([&] { scene(text.replace(at, from.size(), to)); });
    for (Problem& p : problems) {
      EXPECT_EQ(p.key.find("organs[0]."), 0u) << p.key;
      p.key.erase(0, 10);
    }
    return problems;
  }

  test::TempFolder folder_;
};

TEST_F(BodyFields, ArriveInAScene) {
  const Scene read = scene(std::string(kBody) + "damping: {mass: 2.5, stiffness: 0.01}\n");
  expectBody(read.organs.at(0));
  EXPECT_EQ(read.organs[0].damping.mass, 2.5);
  EXPECT_EQ(read.organs[0].damping.stiffness, 0.01);
}

TEST_F(BodyFields, ArriveInACase) {
  const analysis::Case read = analysis::readCase(folder_.write(
      "case.yaml", "mesh: {file: a.vtu}\n" + std::string(kBody) +
                       "analysis: {kind: dynamic, duration: 2, ramp_time: 0.5, damping: {mass: 3, "
                       "stiffness: 0.2}}\n"));
  expectBody(read);
  const auto& analysis = std::get<analysis::DynamicAnalysis>(read.analysis);
  EXPECT_EQ(analysis.ramp_time.value(), 0.5);
  EXPECT_EQ(analysis.damping.mass, 3.0);
  EXPECT_EQ(analysis.damping.stiffness, 0.2);
  EXPECT_FALSE(analysis::DynamicAnalysis().ramp_time);
  EXPECT_EQ(analysis::DynamicAnalysis().damping.mass, 0.0);
}

TEST_F(BodyFields, FileStandsAlone) {
  EXPECT_TRUE(hasProblem(problemsWith("{law: neo", "{file: a.yaml, law: neo"), "material.law",
                         "only with no file"));
  for (const char* key : {"density: 1000", "c10: 1.0", "viscoelastic: []", "mu: 5"}) {
    const std::string name = std::string(key).substr(0, std::string(key).find(':'));
    EXPECT_TRUE(hasProblem(problemsWith("capsule.yaml}", "capsule.yaml, " + std::string(key) + "}"),
                           "regions[0].material." + name, "only with no file"));
  }
}

TEST_F(BodyFields, Viscoelastic) {
  EXPECT_TRUE(
      hasProblem(problemsWith("g: 0.45", "g: 1.5"), "material.viscoelastic[0].g", "in (0, 1)"));
  EXPECT_TRUE(
      hasProblem(problemsWith("g: 0.45", "g: 0.9"), "material.viscoelastic", "sum of g = 1.265"));
  EXPECT_TRUE(hasProblem(problemsWith("g: 0.45, tau: 0.5", "g: 0.45"),
                         "material.viscoelastic[0].tau", "is missing"));
}

TEST_F(BodyFields, ConstantsAreBlamedByName) {
  EXPECT_TRUE(hasProblem(problemsWith("mu: 1.0e3", "mu: -2"), "material.mu",
                         "must be one number > 0, finite"));
  EXPECT_TRUE(
      hasProblem(problemsWith("law: neo_hookean, mu: 1.0e3", "law: mooney_rivlin, c10: 1, c01: -2"),
                 "material", "c10 + c01 = -1: must be > 0"));
  // A law that cannot be made is no fault of its relaxation.
  EXPECT_EQ(problemsWith("law: neo_hookean", "law: neo_hokean").size(), 1u);
  EXPECT_EQ(problemsWith("mu: 1.0e3", "mu: -2").size(), 1u);
  EXPECT_TRUE(hasProblem(problemsWith("law: neo_hookean", "law: linear"), "material.viscoelastic",
                         "law linear is for small rotations"));
}

TEST_F(BodyFields, Regions) {
  EXPECT_TRUE(
      hasProblem(problemsWith("name: core", "name: capsule"), "regions[1].name", "must differ"));
  EXPECT_TRUE(hasProblem(problemsWith("    fibres: {field: fibre_directions, sheet_field: "
                                      "sheet_directions}\n",
                                      ""),
                         "regions[1]", "at least one of material, fibres"));
  EXPECT_TRUE(hasProblem(problemsWith("{depth: {max: 0.001}}", "{}"), "regions[0].select",
                         "exactly one of box, sphere, half_space, cell_data, depth"));
  EXPECT_TRUE(
      hasProblem(problemsWith("{max: 0.001}", "{}"), "regions[0].select.depth", "needs min, max"));
  EXPECT_TRUE(hasProblem(problemsWith("min: 0.01, max: 0.02", "min: 0.03, max: 0.02"),
                         "regions[1].select.depth", "min <= max"));
  EXPECT_TRUE(hasProblem(problemsWith("value: 3", "value: 3.5"),
                         "regions[2].select.cell_data.value", "whole number"));
  EXPECT_TRUE(hasProblem(problemsWith("normal: [0, 0, 2]", "normal: [0, 0, 0]"),
                         "regions[6].select.half_space.normal", "not be zero"));
  EXPECT_TRUE(hasProblem(problemsWith("{depth: {max: 0.001}}", "{plane: {axis: z, at: 0}}"),
                         "regions[0].select.plane", "no such key"));
}

TEST_F(BodyFields, Fibres) {
  EXPECT_TRUE(hasProblem(problemsWith("direction: [0, 0, 1]", "direction: [0, 0, 0]"),
                         "fibres.direction", "not be zero"));
  EXPECT_TRUE(hasProblem(problemsWith("sheet: [1, 0, 0]", "sheet: [0, 0, -3]"), "fibres.sheet",
                         "parallel"));
  EXPECT_TRUE(
      hasProblem(problemsWith("sheet: [1, 0, 0]", "sheet: [0, 0, 0]"), "fibres.sheet", "zero"));
  EXPECT_TRUE(hasProblem(problemsWith("direction: [0, 0, 1], ", ""), "fibres",
                         "exactly one of direction, field"));
  EXPECT_TRUE(hasProblem(problemsWith("sheet: [1, 0, 0]", "sheet: [1, 0, 0], sheet_field: s"),
                         "fibres", "at most one of sheet, sheet_field"));
}

TEST_F(BodyFields, Damping) {
  EXPECT_TRUE(hasProblem(problemsWith("regions:", "damping: {mass: -1}\nregions:"), "damping.mass",
                         "in [0, "));
}

}  // namespace
}  // namespace palpate::scene::body_fields_test
