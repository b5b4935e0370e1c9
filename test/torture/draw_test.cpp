// SPDX-License-Identifier: GPL-3.0-or-later
// What is drawn depends on seed and number alone, and holds what torture promises.
#include "palpate/torture/draw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "palpate/contact/contact_models.h"
#include "palpate/material/material.h"
#include "palpate/mesh/quality.h"
#include "palpate/scene/scene.h"
#include "palpate/tissue/method_facts.h"
#include "palpate/tissue/model_list.h"
#include "palpate/torture/scene_files.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"
#include "torture/draw_body.h"
#include "torture/draw_mesh.h"

namespace palpate::torture::draw_test {
namespace {

constexpr int kMany = 520;  // forty of each category

std::string filesOf(int seed, int number) {
  const test::TempFolder folder;
  const SceneFiles files =
      writeScene(drawScene(static_cast<std::uint64_t>(seed), number), folder.path(""));
  return test::fileBytes(files.scene) + test::fileBytes(files.trajectory);
}

TEST(Draw, IsTheSameOnAllMachines) {
  Draw draw(1, 2);
  EXPECT_EQ(draw.between(0.0, 1.0), Draw(1, 2).between(0.0, 1.0));
  EXPECT_NE(Draw(1, 2).between(0.0, 1.0), Draw(2, 1).between(0.0, 1.0));
  double sum = 0.0, least = 1.0, most = 0.0;
  for (int k = 0; k < 10000; ++k) {
    const double u = draw.between(0.0, 1.0);
    sum += u, least = std::min(least, u), most = std::max(most, u);
  }
  EXPECT_NEAR(sum / 10000, 0.5, 0.01);  // three and a half standard deviations
  EXPECT_LT(least, 1e-3);
  EXPECT_GT(most, 1.0 - 1e-3);
  Vec3 middle = Vec3::Zero();
  for (int k = 0; k < 10000; ++k) {
    const Vec3 d = draw.direction();
    EXPECT_NEAR(d.norm(), 1.0, 1e-12);
    middle += d / 10000;
  }
  EXPECT_LT(middle.norm(), 0.03);
}

TEST(DrawnScene, IsThatOfItsSeedAndNumber) {
  for (const int number : {0, 7, 31}) {
    EXPECT_EQ(filesOf(1, number), filesOf(1, number));
    EXPECT_NE(filesOf(1, number), filesOf(1, number + 13));
    EXPECT_NE(filesOf(1, number), filesOf(2, number));
  }
}

TEST(DrawnScenes, HaveAllThatThereIs) {
  std::set<std::string> categories_seen, models, elements, laws, methods, integrators, tools,
      starts, contacts, schemes;
  for (int number = 0; number < kMany; ++number) {
    const TortureScene scene = drawScene(1, number);
    categories_seen.insert(scene.category);
    for (const TortureOrgan& organ : scene.organs) {
      models.insert(organ.model);
      elements.insert(organ.element);
      laws.insert(organ.law);
      schemes.insert(organ.scheme);
      EXPECT_GE(organ.poisson, 0.0);
      EXPECT_LE(organ.poisson, 0.4999);
      EXPECT_GE(organ.young, 1e2);
      EXPECT_LE(organ.young, 1e8);
      EXPECT_GE(organ.density, 1.0);
      EXPECT_LE(organ.density, 1e5);
    }
    methods.insert(scene.method);
    integrators.insert(scene.integrator);
    for (const TortureTool& tool : scene.tools) tools.insert(tool.shape);
    starts.insert(toString(scene.start));
    contacts.insert(scene.contact);
    EXPECT_GE(scene.step, 1e-4);
    EXPECT_LE(scene.step, 0.1);
    EXPECT_LE(scene.trajectory.t.size(), 90u + 10u + 3u * 700u);  // go, leave and rest
  }
  EXPECT_EQ(categories_seen.size(), categories().size());
  EXPECT_EQ(models.size(), tissue::modelNames().size());
  EXPECT_EQ(elements.size(), 5u);
  EXPECT_EQ(laws.size(), material::materialNames().size());
  EXPECT_EQ(methods.size(), tissue::methodNames().size());
  EXPECT_EQ(integrators.size(), 3u);
  EXPECT_EQ(tools.size(), toolShapes().size());
  EXPECT_EQ(starts.size(), 8u);
  EXPECT_EQ(contacts.size(), contact::contactModelNames().size());
  EXPECT_EQ(schemes.size(), 4u);
}

TEST(DrawnMeshes, AreWholeAndAsFlatAsTheySay) {
  int slivers = 0;
  for (int number = 0; number < kMany; ++number) {
    const TortureScene scene = drawScene(1, number);
    const TortureOrgan& organ = scene.organs.front();
    if (organ.mesh.numTets() == 0) continue;
    const mesh::TetQuality quality = mesh::measureQuality(organ.mesh);
    EXPECT_NEAR(quality.min_dihedral_deg, organ.min_dihedral, 1e-6);
    EXPECT_GE(organ.min_dihedral, 0.99) << describe(scene);
    EXPECT_LE(organ.mesh.numTets(), 30000);
    if (organ.shape != "sliver" || organ.mesh.numTets() < 300) continue;
    ++slivers;
    EXPECT_LE(organ.min_dihedral, 10.1) << describe(scene);
  }
  EXPECT_GT(slivers, 20);
}

TEST(DrawnLaws, HaveTheModuliThatTheyWereAskedFor) {
  for (const std::string& law : material::materialNames()) {
    for (const double poisson : {0.0, 0.3, 0.4999}) {
      const material::Moduli m =
          material::moduli(material::makeMaterial(law, constantsOf(law, 5e4, poisson)));
      const material::Moduli wanted = material::moduliFromYoung(5e4, poisson);
      EXPECT_NEAR(m.mu / wanted.mu, 1.0, 1e-9) << law;
      EXPECT_NEAR(m.kappa / wanted.kappa, 1.0, 1e-9) << law;
    }
  }
}

TEST(DrawnScenes, AreScenesOfAUser) {
  const test::TempFolder folder;
  for (int number = 0; number < kMany; ++number) {
    const SceneFiles files = writeScene(drawScene(1, number), folder.path(""));
    EXPECT_NO_THROW(scene::readScene(files.scene)) << number;
  }
}

}  // namespace
}  // namespace palpate::torture::draw_test
