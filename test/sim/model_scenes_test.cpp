// SPDX-License-Identifier: GPL-3.0-or-later
// The shipped block of each model against finite elements: pressed, held, slid over and let go.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "palpate/base/error.h"
#include "shipped_replay.h"
#include "support/contains.h"

namespace palpate::sim::model_scenes_test {
namespace {

class ModelScenes : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Slabs, ModelScenes,
                         ::testing::Values("slab_springs", "slab_tensor_mass", "slab_hybrid",
                                           "slab_sampled", "slab_bem", "slab_enriched",
                                           "slab_neural"),
                         [](const auto& of) { return of.param; });

TEST_P(ModelScenes, PushBackAndLetGo) {
  test::ShippedReplay replay(GetParam(), "slab_probe");
  const auto force = [&](double t) { return replay.to(t).instruments[0].spatial.force.norm(); };
  EXPECT_EQ(force(0.2), 0.0);
  force(0.8);
  double last = 0.0, rough = 0.0;  // the force of the cycle before, the largest change of it
  const double held = replay
                          .to(1.4,
                              [&](const StepResult& result) {
                                const double now = result.instruments[0].spatial.force.norm();
                                if (last > 0.0) rough = std::max(rough, std::abs(now - last));
                                last = now;
                              })
                          .instruments[0]
                          .spatial.force.norm();
  EXPECT_LT(rough, 2e-3 * held);  // no swing under a tool that does not move
  const double slid = force(2.6);
  std::printf("%s: %.3f N held, %.3f N after the slide\n", GetParam().c_str(), held, slid);
  // A ball of 5 mm, 3 mm deep in a half space of 10 kPa: 16/9 E sqrt(R d^3) = 0.21 N, and more on a
  // table 30 mm below and with edges of 6 mm.
  EXPECT_GT(held, 0.15);
  EXPECT_LT(held, 0.6);
  EXPECT_NEAR(slid, held, 0.5 * held);
  EXPECT_EQ(force(3.3), 0.0);
}

// Of edges that the model has no use for or cannot have, the file and the key are named.
TEST(BemScene, IsRefusedWithEdgesThatItCannotHave) {
  const auto refusal = [](const scene::EdgeLengthConfig& edges) {
    scene::Scene scene = scene::readScene(test::sourceFolder() + "/config/scenes/slab_bem.yaml");
    scene.organs[0].edge_length = edges;
    try {
      const Simulator simulator(scene);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  using test::contains;
  scene::EdgeLengthConfig edges;
  edges.coarsest = 0.005;
  EXPECT_TRUE(contains(refusal(edges), "organs[0]"));
  EXPECT_TRUE(contains(refusal(edges), "at most 1000"));
  edges.near.emplace_back();
  EXPECT_TRUE(contains(refusal(edges), "slab_bem.yaml"));
  EXPECT_TRUE(contains(refusal(edges), "organs[0].edge_length.near"));
}

// The file, the key and its value are named.
TEST(EnrichedScene, IsRefusedWithSurfacesAndFoldersThatCannotBe) {
  scene::Scene scene = scene::readScene(test::sourceFolder() + "/config/scenes/slab_enriched.yaml");
  tissue::EnrichedSettings& enriched = scene.organs[0].enriched;
  enriched.plan.samples = 1;
  enriched.plan.triangles = 101;
  const auto refusal = [&] {
    try {
      const Simulator simulator(scene);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  using test::contains;
  EXPECT_TRUE(contains(refusal(), "slab_enriched.yaml"));
  EXPECT_TRUE(contains(refusal(), "organs[0].enriched.triangles = 101"));
  enriched.plan.triangles = 100;
  enriched.database = "nowhere";
  EXPECT_TRUE(contains(refusal(), "nowhere"));
}

// A sheet between two edges is a rope more than a plate: what pulls is its stretch.
TEST(ClothScene, PushesBackAndLetsGo) {
  test::ShippedReplay replay("cloth");
  const auto force = [&](double t) { return replay.to(t).instruments[0].spatial.force.norm(); };
  const Points rest = replay.simulator().positions(0);
  EXPECT_EQ(force(0.2), 0.0);
  const double held = force(1.4), slid = force(2.5);
  std::printf("cloth: %.3f N held, %.3f N after the slide\n", held, slid);
  // 7.5 mm deep in the middle of a span of 0.1 m strips of 10 to 50 mm, of E h = 5 kN/m, are
  // stretched by 1.1 %, and pull at 0.15 to 1: 2 E h w (d/l)^3.
  EXPECT_GT(held, 2.0 * 5e3 * 0.01 * std::pow(0.0075 / 0.05, 3));
  EXPECT_LT(held, 2.0 * 5e3 * 0.10 * std::pow(0.0075 / 0.05, 3));
  EXPECT_GT(slid, 0.3 * held);
  EXPECT_EQ(force(3.5), 0.0);
  EXPECT_LT((replay.simulator().positions(0) - rest).cwiseAbs().maxCoeff(), 5e-4);
}

}  // namespace
}  // namespace palpate::sim::model_scenes_test
