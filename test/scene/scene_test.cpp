// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/scene/scene.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "palpate/material/material.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"

namespace palpate::scene::scene_test {
namespace {

const std::string kSource = test::sourceFolder();

TEST(Scene, EveryShippedOneIsRead) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kSource + "/config/scenes")) {
    if (entry.path().extension() != ".yaml") continue;
    SCOPED_TRACE(entry.path());
    Scene scene;
    ASSERT_NO_THROW(scene = readScene(entry.path().string()));
    EXPECT_FALSE(scene.organs.empty());
    EXPECT_FALSE(scene.instruments.empty());
    EXPECT_FALSE(scene.organs.at(0).supports.empty());
    ++count;
  }
  EXPECT_GE(count, 4);
}

TEST(Scene, ValuesArriveWhereTheyBelong) {
  const test::TempFolder folder;
  const std::string file = folder.write("all.yaml", R"(
name: everything set
gravity: [0.1, 0.2, -9.7]
organs:
  - name: a
    surface: a.obj
    scale: 0.001
    edge_length: 0.02
    pose: {position: [1, 2, 3], roll_pitch_yaw: [0.1, 0.2, 0.3]}
    element: tet4
    material: {law: neo_hookean, mu: 1.0e4, kappa: 2.0e5, density: 900}
    supports:
      - select: {plane: {axis: x, at: 0.5}}
      - select: {plane: {axis: y, at: 0.5, tolerance: 0.01}}
      - select: {box: {min: [0, 0, 0], max: [1, 2, 3]}}
      - select: {sphere: {center: [1, 1, 1], radius: 0.25}}
  - name: b
    tetrahedra: b.msh
    material: {young_modulus: 5000, poisson_ratio: 0.3}
instruments:
  - name: tool
    urdf: package://palpate/tool.urdf
    base: {position: [0, 0, 1]}
    input: tf
    joint_topic: /arm/joints
    tf_prefix: left/
    control_frame: tip
    cylinder_as_capsule: false
contact: {stiffness: 1.0e6, smoothing: 0.001, sample_spacing: 0.002}
solver: {step: 0.004, tolerance: 1.0e-5, max_newton_iterations: 7, linear_tolerance: 0.1,
         max_linear_iterations: 33, threads: 2}
rates: {simulation: 250, haptic: 500, markers: 25, stale_after: 0.3, ramp: 0.2}
haptics: {max_force: 5, max_torque: 0.5, max_force_rate: 100}
)");
  const Scene scene = readScene(file);
  EXPECT_EQ(scene.file, file);
  EXPECT_EQ(scene.name, "everything set");
  EXPECT_EQ(scene.gravity, Vec3(0.1, 0.2, -9.7));
  ASSERT_EQ(scene.organs.size(), 2u);
  const OrganConfig& a = scene.organs[0];
  EXPECT_EQ(a.surface, "a.obj");
  EXPECT_EQ(a.scale, 0.001);
  EXPECT_EQ(a.edge_length.coarsest, 0.02);
  EXPECT_TRUE(a.edge_length.uniform());
  EXPECT_EQ(a.pose.position, Vec3(1, 2, 3));
  EXPECT_EQ(a.pose.roll_pitch_yaw, Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(a.material.law, "neo_hookean");
  EXPECT_EQ(a.material.density, 900.0);
  EXPECT_EQ(material::moduli(material::makeMaterial(a.material.law, a.material.constants)).kappa,
            2e5);
  ASSERT_EQ(a.supports.size(), 4u);
  const auto& x_plane = std::get<mesh::PlaneRegion>(a.supports[0].select);
  EXPECT_EQ(x_plane.axis, 0);
  EXPECT_EQ(x_plane.at, 0.5);
  EXPECT_LT(x_plane.tolerance, 0.0);
  EXPECT_EQ(std::get<mesh::PlaneRegion>(a.supports[1].select).axis, 1);
  EXPECT_EQ(std::get<mesh::PlaneRegion>(a.supports[1].select).tolerance, 0.01);
  EXPECT_EQ(std::get<mesh::BoxRegion>(a.supports[2].select).max, Vec3(1, 2, 3));
  EXPECT_EQ(std::get<mesh::SphereRegion>(a.supports[3].select).radius, 0.25);
  EXPECT_EQ(scene.organs[1].tetrahedra, "b.msh");
  EXPECT_EQ(scene.organs[1].material.law, "stable_neo_hookean");
  ASSERT_EQ(scene.instruments.size(), 1u);
  const InstrumentConfig& tool = scene.instruments[0];
  EXPECT_EQ(tool.urdf, "package://palpate/tool.urdf");
  EXPECT_EQ(tool.base.position, Vec3(0, 0, 1));
  EXPECT_EQ(tool.input, "tf");
  EXPECT_EQ(tool.joint_topic, "/arm/joints");
  EXPECT_EQ(tool.tf_prefix, "left/");
  EXPECT_EQ(tool.control_frame, "tip");
  EXPECT_FALSE(tool.cylinder_as_capsule);
  EXPECT_EQ(scene.contact.stiffness, 1e6);
  EXPECT_EQ(scene.contact.smoothing, 0.001);
  EXPECT_EQ(scene.contact.sample_spacing, 0.002);
  EXPECT_EQ(scene.solver.step, 0.004);
  EXPECT_EQ(scene.solver.tolerance, 1e-5);
  EXPECT_EQ(scene.solver.max_newton_iterations, 7);
  EXPECT_EQ(scene.solver.linear_tolerance, 0.1);
  EXPECT_EQ(scene.solver.max_linear_iterations, 33);
  EXPECT_EQ(scene.solver.threads, 2);
  EXPECT_EQ(scene.rates.simulation, 250.0);
  EXPECT_EQ(scene.rates.haptic, 500.0);
  EXPECT_EQ(scene.rates.markers, 25.0);
  EXPECT_EQ(scene.rates.stale_after, 0.3);
  EXPECT_EQ(scene.rates.ramp, 0.2);
  EXPECT_EQ(scene.haptics.max_force, 5.0);
  EXPECT_EQ(scene.haptics.max_torque, 0.5);
  EXPECT_EQ(scene.haptics.max_force_rate, 100.0);
}

TEST(Scene, EdgesMayDifferFromPlaceToPlace) {
  const test::TempFolder folder;
  const Scene scene = readScene(folder.write("scene.yaml", R"(organs:
  - name: a
    surface: a.obj
    material: {young_modulus: 6000.0, poisson_ratio: 0.45, density: 1060.0}
    edge_length:
      coarsest: 0.02
      near:
        - {finest: 0.001, point: [1, 2, 3], radius: 0.008, growth: 0.5}
        - {finest: 0.002, path: [[0, 0, 0], [0, 0.1, 0]]}
        - {finest: 0.003, region: {sphere: {center: [0, 0, 0.1], radius: 0.01}}}
        - {finest: 0.004, surface: true, growth: 1}
)"));
  const EdgeLengthConfig& field = scene.organs[0].edge_length;
  EXPECT_EQ(field.coarsest, 0.02);
  ASSERT_EQ(field.near.size(), 4u);
  EXPECT_EQ(field.near[0].finest, 0.001);
  EXPECT_EQ(field.near[0].radius, 0.008);
  EXPECT_EQ(field.near[0].growth, 0.5);
  ASSERT_EQ(std::get<mesh::Polyline>(field.near[0].where).points.size(), 1u);
  EXPECT_EQ(std::get<mesh::Polyline>(field.near[0].where).points[0], Vec3(1, 2, 3));
  EXPECT_EQ(field.near[1].growth, mesh::RefinementZone().growth);
  EXPECT_EQ(field.near[1].radius, 0.0);
  ASSERT_EQ(std::get<mesh::Polyline>(field.near[1].where).points.size(), 2u);
  EXPECT_EQ(std::get<mesh::Polyline>(field.near[1].where).points[1], Vec3(0, 0.1, 0));
  const auto& region = std::get<mesh::Region>(field.near[2].where);
  EXPECT_EQ(std::get<mesh::SphereRegion>(region).radius, 0.01);
  EXPECT_TRUE(std::holds_alternative<mesh::OwnSurface>(field.near[3].where));
}

TEST(SceneFormat, CommittedPageIsTheGeneratedOne) {
  EXPECT_EQ(test::fileBytes(kSource + "/docs/scene_format.md"), sceneFormatMarkdown())
      << "regenerate: palpate docs scene_format > docs/scene_format.md";
}

TEST(SceneFormat, NamesKeysRangesAndLaws) {
  const std::string page = sceneFormatMarkdown();
  for (const char* part :
       {"## `organs[].supports[].select.plane`", "| `edge_length` | number or section | m | `0.01`",
        "## `organs[].edge_length.near[]`", "| `path` | list of points |",
        "| `step` | number | s | `0.01`", "in (0, 0.1]", "needs exactly one of surface, tetrahedra",
        "`stable_neo_hookean`", "young_modulus", "names in organs must differ"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
}

}  // namespace
}  // namespace palpate::scene::scene_test
