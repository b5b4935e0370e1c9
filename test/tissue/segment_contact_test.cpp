// SPDX-License-Identifier: GPL-3.0-or-later
// A tool that is a segment, and the displacements that it prescribes (contact.model prescribed).
#include "tissue/methods/prescribed/segment_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <tuple>
#include <vector>

#include "liver_slab.h"
#include "support/contains.h"
#include "support/random.h"

namespace palpate::tissue::segment_contact_test {
namespace {

using test::LiverSlab;
constexpr double kStep = 0.01, kTop = 0.04;
constexpr double kOnTool = 1e-9;  // [m]
const Vec3 kVertex(0.05, 0.05, kTop), kEdge(0.055, 0.05, kTop), kFace(0.0533, 0.0521, kTop);

LiverSlab slabOf(const std::string& law = "neo_hookean",
                 const Eigen::Vector3i& cells = Eigen::Vector3i(8, 8, 4)) {
  LiverSlab slab("newton_bicgstab", cells, "tet4");
  slab.law = material::makeMaterial(law, material::exampleConstants(law));
  slab.density = 1000.0;
  slab.settings.contact.model = "prescribed";
  return slab;
}

// A rod of 100 mm and 2 mm radius along z; `tip` is its lower end.
struct Rod {
  instrument::Geometry shape = instrument::Capsule{0.002, 0.048};
  Vec3 tilt = Vec3::Zero();  // roll, pitch, yaw
  Pose at(const Vec3& tip) const {
    const Pose turned = poseFromXyzRpy(Vec3::Zero(), tilt);
    return poseFromXyzRpy(tip + turned.linear() * Vec3(0.0, 0.0, 0.05), tilt);
  }
  contact::Obstacle move(const Vec3& from, const Vec3& to) const {
    return {&shape, 0, at(from), at(to)};
  }
};

// The point of the surface that is `place` at rest.
struct Material {
  Eigen::Vector3i nodes;
  Vec3 weights;
  Material(const mesh::TetMesh& mesh, const Vec3& place) {
    const Eigen::Matrix3Xi triangles = mesh::trianglesOf(mesh::boundaryFaces(mesh));
    contact::SegmentTracker tracker(mesh.points, triangles);
    std::vector<contact::SegmentHit> hits;
    tracker.find(mesh.points, place + Vec3(0, 0, 0.01), place - Vec3(0, 0, 0.01), &hits);
    EXPECT_FALSE(hits.empty());
    nodes = triangles.col(hits.front().triangle);
    weights = hits.front().weights;
  }
  Vec3 at(const Points& x) const {
    Vec3 p = Vec3::Zero();
    for (int k = 0; k < 3; ++k) p += weights[k] * x.col(nodes[k]);
    return p;
  }
};

void expectBalanced(const TissueStep& step, Eigen::Index nodes) {
  EXPECT_LE(step.residual, step.tolerance);
  EXPECT_LT(test::imbalance(step).norm(),
            std::sqrt(static_cast<double>(nodes)) * step.tolerance + 1e-9);
}

class SegmentPlaces : public ::testing::TestWithParam<std::tuple<std::string, Vec3>> {};
INSTANTIATE_TEST_SUITE_P(
    Laws, SegmentPlaces,
    ::testing::Combine(::testing::Values("linear", "st_venant_kirchhoff", "neo_hookean",
                                         "mooney_rivlin", "yeoh"),
                       ::testing::Values(kVertex, kEdge, kFace)),
    [](const auto& of) {
      const Vec3& at = std::get<1>(of.param);
      return std::get<0>(of.param) + (at == kVertex ? "_vertex" : at == kEdge ? "_edge" : "_face");
    });

// Down, up again and away: the point that was hit goes with the tip, the force pushes and balances
// what the supports exert, and when the tool has left there is none.
TEST_P(SegmentPlaces, GoesWithTheTipAndIsLetGo) {
  const auto& [law, place] = GetParam();
  const LiverSlab slab = slabOf(law);
  const auto tissue = slab.make();
  const Material point(slab.mesh, place);
  const Rod rod;
  const auto tip = [&, at = place](int k) -> Vec3 {
    return at + Vec3(0.0, 0.0, 0.001 - 0.0005 * (k <= 10 ? k : 20 - k));
  };
  double last = 0.0;
  for (int k = 0; k < 20; ++k) {
    const TissueStep& step = tissue->step({rod.move(tip(k), tip(k + 1))}, kStep);
    ASSERT_TRUE(step.ok()) << k << " " << solver::toString(step.status);
    expectBalanced(step, slab.mesh.numPoints());
    const double depth = kTop - tip(k + 1).z();
    if (depth > 1e-9) {
      ASSERT_EQ(step.contacts.size(), 1U) << k;
      EXPECT_LT((point.at(tissue->positions()) - tip(k + 1)).norm(), kOnTool) << k;
      EXPECT_LT((step.contacts[0].p_W - tip(k + 1)).norm(), kOnTool) << k;
      EXPECT_GT(test::onTool(step).z(), 0.0) << k;
      EXPECT_TRUE(k >= 10 || test::onTool(step).z() > last) << k;
    } else if (depth < -1e-9) {
      EXPECT_TRUE(step.contacts.empty()) << k;
    }
    last = test::onTool(step).z();
  }
  const TissueStep& gone = tissue->step({rod.move(tip(20), tip(20) + Vec3(0, 0, 0.05))}, kStep);
  EXPECT_TRUE(gone.contacts.empty());
  EXPECT_LT((tissue->positions() - slab.mesh.points).cwiseAbs().maxCoeff(), 1e-5);
}

// What the tool does is what the tissue stores.
TEST_P(SegmentPlaces, ForceIsTheDerivativeOfTheEnergy) {
  const auto& [law, place] = GetParam();
  LiverSlab slab = slabOf(law);
  slab.settings.tolerance = 1e-9;
  slab.settings.position_tolerance = 1e-10;
  slab.settings.linear_tolerance = 1e-8;
  const auto tissue = slab.make();
  const Rod rod;
  const double h = 1e-5;
  Vec3 from = place + Vec3(0, 0, 0.001);
  double energy[3], force = 0.0;
  for (int k = 0; k < 3; ++k) {
    const Vec3 to = place - Vec3(0, 0, 0.003 + h * (k - 1));
    const TissueStep& step = tissue->step({rod.move(from, to)}, kStep);
    ASSERT_TRUE(step.ok()) << solver::toString(step.status);
    energy[k] = step.elastic_energy;
    if (k == 1) force = test::onTool(step).z();
    from = to;
  }
  // Differences are off by h^2/6 F''': F bends over millimetres.
  EXPECT_NEAR((energy[2] - energy[0]) / (2.0 * h), force, 1e-4 * force);
}

// Over vertices, edges and faces, down and up.
TEST(SegmentContact, IsFollowedOverTheSurface) {
  LiverSlab slab = slabOf();
  const auto tissue = slab.make();
  Rod rod;
  rod.tilt = Vec3(0.2, 0.1, 0.0);
  const auto tip = [](int k) {
    return Vec3(0.03 + 0.0005 * k, 0.041 + 0.0003 * k, kTop - 0.003 - 0.001 * std::sin(0.2 * k));
  };
  ASSERT_TRUE(tissue->step({rod.move(tip(0) + Vec3(0, 0, 0.006), tip(0))}, kStep).ok());
  for (int k = 0; k < 80; ++k) {
    const TissueStep& step = tissue->step({rod.move(tip(k), tip(k + 1))}, kStep);
    ASSERT_TRUE(step.ok()) << k << " " << solver::toString(step.status);
    expectBalanced(step, slab.mesh.numPoints());
    ASSERT_EQ(step.contacts.size(), 1U) << k;
    EXPECT_LT((step.contacts[0].p_W - tip(k + 1)).norm(), kOnTool) << k;
    EXPECT_GT(test::onTool(step).z(), 0.0) << k;
    EXPECT_GT(step.min_jacobian, 0.0) << k;
  }
}

// Leaps in, far away, through and through, and back: no force of what is no longer touched.
TEST(SegmentContact, SurvivesLeaps) {
  const LiverSlab slab = slabOf();
  const auto tissue = slab.make();
  const Rod rod;
  const Vec3 above = kFace + Vec3(0, 0, 0.02), inside = kFace - Vec3(0, 0, 0.012);
  const Vec3 away(0.5, 0.5, 0.5), below = kFace - Vec3(0, 0, 0.06), aside(0.02, 0.07, 0.035);
  Vec3 from = above;
  for (const Vec3& to : {inside, away, above, inside, aside, above, below, away, above, inside}) {
    const TissueStep& step = tissue->step({rod.move(from, to)}, kStep);
    ASSERT_TRUE(tissue->positions().allFinite());
    ASSERT_TRUE(test::onTool(step).allFinite());
    EXPECT_GT(step.min_jacobian, 0.0);
    if (to == away || to == above) {
      EXPECT_TRUE(step.contacts.empty());
    }
    from = to;
  }
  EXPECT_GT(test::onTool(tissue->step({rod.move(inside, inside)}, kStep)).z(), 0.0);
  EXPECT_TRUE(tissue->step({}, kStep).contacts.empty());
  EXPECT_LT((tissue->positions() - slab.mesh.points).cwiseAbs().maxCoeff(), 1e-5);
}

double distance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double part = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - part * (b - a)).norm();
}

// A hand that trembles, turns and sometimes leaps: what is solved is in balance and touches the
// tool, whatever is not solved leaves no trace, and in the end nothing is left of any of it.
TEST(SegmentContact, SurvivesARandomHand) {
  const LiverSlab slab = slabOf("neo_hookean", Eigen::Vector3i(6, 6, 3));
  const auto tissue = slab.make();
  test::Random random(5);
  Rod rod;
  Pose from = rod.at(kFace + Vec3(0, 0, 0.01));
  int touched = 0, unsolved = 0;
  for (int k = 0; k < 400; ++k) {
    const bool leaps = k % 20 == 19;
    if (k % 20 == 0) rod.tilt = random.vector(0.6);
    rod.tilt += random.vector(leaps ? 0.5 : 0.03);
    const Vec3 middle(0.05, 0.05, kTop - 0.004);
    const Vec3 tip = middle + (leaps ? random.vector(0.06)
                                     : Vec3(random.vector(1.0).cwiseProduct(
                                           Vec3(0.004 + 0.0015 * (k % 20), 0.02, 0.008))));
    const Pose to = rod.at(tip);
    const TissueStep& step = tissue->step({{&rod.shape, 0, from, to}}, kStep);
    from = to;
    ASSERT_TRUE(tissue->positions().allFinite()) << k;
    ASSERT_TRUE(test::onTool(step).allFinite()) << k;
    if (!step.ok()) {
      ++unsolved;
      continue;
    }
    expectBalanced(step, slab.mesh.numPoints());
    ASSERT_LE(step.contacts.size(), 1U);
    for (const TissueContact& c : step.contacts) {
      ++touched;
      EXPECT_LT(distance(c.p_W, to * Vec3(0, 0, -0.05), to * Vec3(0, 0, 0.05)), kOnTool) << k;
    }
  }
  std::printf("%d cycles touched, %d not solved\n", touched, unsolved);
  EXPECT_GT(touched, 50);
  for (int k = 0; k < 5; ++k) EXPECT_TRUE(tissue->step({}, kStep).contacts.empty());
  EXPECT_LT((tissue->positions() - slab.mesh.points).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(SegmentContact, LetsAToolBeThatStartsInside) {
  const LiverSlab slab = slabOf();
  const auto tissue = slab.make();
  const Rod rod;
  const Vec3 inside = kFace - Vec3(0, 0, 0.02), above = kFace + Vec3(0, 0, 0.01);
  for (int k = 0; k < 3; ++k) {
    const TissueStep& step = tissue->step({rod.move(inside, inside)}, kStep);
    EXPECT_TRUE(step.contacts.empty());
    EXPECT_EQ(step.tools_inside, 1);
  }
  EXPECT_TRUE(tissue->step({rod.move(inside, above)}, kStep).contacts.empty());
  tissue->step({rod.move(above, above)}, kStep);
  const TissueStep& pressed = tissue->step({rod.move(above, kFace - Vec3(0, 0, 0.003))}, kStep);
  EXPECT_GT(test::onTool(pressed).z(), 0.0);
}

// Both ends outside, across the slab's upper edge: it is pushed, and let go.
TEST(SegmentContact, PushesWithItsSide) {
  const LiverSlab slab = slabOf();
  const auto tissue = slab.make();
  Rod rod;
  rod.tilt = Vec3(0.0, -M_PI / 4.0, 0.0);
  const Vec3 along = poseFromXyzRpy(Vec3::Zero(), rod.tilt).linear() * Vec3::UnitZ();
  const Vec3 across = Vec3(-1.0, 0.0, -1.0).normalized(), edge(0.1, 0.052, kTop);
  const auto tip = [&, s = std::copysign(1.0, along.z())](double depth) -> Vec3 {
    return edge + depth * across - s * 0.05 * along;
  };
  ASSERT_LT(std::abs(along.dot(across)), 1e-12);
  double pushed = 0.0;
  for (int k = 0; k < 16; ++k) {
    const auto depth = [](int step) { return -0.001 + 0.0005 * (step <= 8 ? step : 16 - step); };
    const TissueStep& step = tissue->step({rod.move(tip(depth(k)), tip(depth(k + 1)))}, kStep);
    ASSERT_TRUE(step.ok()) << k << " " << solver::toString(step.status);
    expectBalanced(step, slab.mesh.numPoints());
    pushed = std::max(pushed, -test::onTool(step).dot(across));
  }
  EXPECT_GT(pushed, 0.01);
  EXPECT_TRUE(tissue->step({rod.move(tip(-0.001), tip(-0.02))}, kStep).contacts.empty());
}

std::vector<Vec3> wander() {
  std::vector<Vec3> tips;
  for (int k = 0; k <= 40; ++k) {
    const double t = 0.15 * k;
    tips.emplace_back(0.05 + 0.01 * std::sin(t), 0.05 + 0.006 * std::sin(2.1 * t),
                      kTop + 0.003 - 0.008 * std::sin(0.5 * t));
  }
  return tips;
}

TEST(SegmentContact, SameInputsSameBitsWhateverTheThreads) {
  ThreadPool pool(3);
  const LiverSlab slab = slabOf("neo_hookean", Eigen::Vector3i(6, 6, 3));
  const auto one = slab.make(), two = slab.make(&pool);
  const Rod rod;
  const std::vector<Vec3> tips = wander();
  for (std::size_t k = 0; k + 1 < tips.size(); ++k) {
    const contact::Obstacle tool = rod.move(tips[k], tips[k + 1]);
    ASSERT_EQ(test::onTool(one->step({tool}, kStep)), test::onTool(two->step({tool}, kStep)));
    ASSERT_EQ(one->positions(), two->positions());
  }
}

// From every cycle on, mid-contact too, another model goes on with the same bits; and a reset one
// begins anew with them.
TEST(SegmentContact, GoesOnFromItsState) {
  const LiverSlab slab = slabOf("neo_hookean", Eigen::Vector3i(6, 6, 3));
  const auto tissue = slab.make(), other = slab.make();
  const Rod rod;
  const std::vector<Vec3> tips = wander();
  std::vector<State> states;
  std::vector<Vec3> forces;
  std::size_t touching = 0;
  for (std::size_t k = 0; k + 1 < tips.size(); ++k) {
    states.push_back(tissue->state());
    forces.push_back(test::onTool(tissue->step({rod.move(tips[k], tips[k + 1])}, kStep)));
    touching += forces.back().isZero() ? 0 : 1;
  }
  EXPECT_GT(touching, 10U);
  for (std::size_t from = 0; from < states.size(); from += 3) {
    other->restore(states[from]);
    for (std::size_t k = from; k < std::min(from + 4, forces.size()); ++k) {
      ASSERT_EQ(test::onTool(other->step({rod.move(tips[k], tips[k + 1])}, kStep)), forces[k])
          << from << " " << k;
    }
  }
  other->reset();
  for (std::size_t k = 0; k < forces.size(); ++k) {
    ASSERT_EQ(test::onTool(other->step({rod.move(tips[k], tips[k + 1])}, kStep)), forces[k]) << k;
  }
}

// To the force of a body of half the shear modulus; what keeps the volume does not relax.
TEST(SegmentContact, RelaxesUnderAHeldTool) {
  const auto law = [](double part) {
    return material::makeMaterial(
        "mooney_rivlin", {{"c10", {600.0 * part}}, {"c01", {400.0 * part}}, {"kappa", {1.0e4}}});
  };
  const Rod rod;
  const Vec3 above = kFace + Vec3(0, 0, 0.001), inside = kFace - Vec3(0, 0, 0.004);
  double force[2];
  for (const bool relaxes : {false, true}) {
    LiverSlab slab = slabOf("mooney_rivlin", Eigen::Vector3i(6, 6, 3));
    slab.law = law(relaxes ? 1.0 : 0.5);
    if (relaxes) slab.prony = {{0.5, 0.1}};
    const auto tissue = slab.make();
    tissue->step({rod.move(above, inside)}, kStep);
    for (int k = 0; k < 80; ++k) {
      const TissueStep& step = tissue->step({rod.move(inside, inside)}, kStep);
      ASSERT_TRUE(step.ok()) << k;
      force[relaxes] = test::onTool(step).z();
    }
  }
  EXPECT_NEAR(force[1], force[0], 2e-3 * force[0]);  // after 8 times of relaxing, e^-8 is left
}

TEST(SegmentContact, WalksAndAsksTheTreeOnce) {
  const LiverSlab slab = slabOf();
  const fem::Composition tissue{{material::Solid{slab.law, slab.density, {}}}, {}, {}};
  FemBody body(slab.mesh, tissue, slab.free, slab.settings, nullptr);
  SegmentContact contact(&body);
  const Rod rod;
  const auto go = [&](const Vec3& from, const Vec3& to) {
    body.tool_path.begin({rod.move(from, to)}, body.x, 0.0);
    contact.beginStage(body.x, 0.0, 1.0);
    contact.holdWhatPenetrates(body.x);
  };
  Vec3 at = kFace - Vec3(0, 0, 1e-3);
  go(kFace + Vec3(0, 0, 1e-3), at);
  EXPECT_EQ(contact.counts().queries, 1);
  for (int k = 0; k < 20; ++k) {
    const Vec3 to = at + Vec3(1e-3, 0.5e-3, 0.0);
    go(at, to);
    at = to;
    Points move;
    contact.moves(body.x, &move);
    EXPECT_GT(move.norm(), 1e-4);
  }
  EXPECT_EQ(contact.counts().queries, 1);
  EXPECT_EQ(contact.counts().walks, 20);
  EXPECT_EQ(contact.counts().lost, 0);
}

// The tree is asked while nothing is held, by every cycle near the surface, and then not again.
TEST(SegmentContact, ReportsTheSearchesOfEachCycle) {
  const LiverSlab slab = slabOf();
  const Rod rod;
  std::vector<TissueStep> cycles[2];
  for (std::vector<TissueStep>& done : cycles) {
    const auto tissue = slab.make();
    Vec3 at = kFace + Vec3(0, 0, 1e-3);
    const auto go = [&](const Vec3& to) {
      done.push_back(tissue->step({rod.move(at, to)}, kStep));
      ASSERT_TRUE(done.back().ok());
      at = to;
    };
    go(kFace + Vec3(0, 0, 0.5e-3));
    EXPECT_GT(done.back().tree_queries, 0);
    EXPECT_EQ(done.back().walk_steps, 0);
    go(kFace - Vec3(0, 0, 1e-3));
    EXPECT_GT(done.back().tree_queries, 0);
    int steps = 0;
    for (int k = 0; k < 20; ++k) {
      go(at + Vec3(1e-3, 0.5e-3, 0.0));
      EXPECT_EQ(done.back().tree_queries, 0) << k;
      steps += done.back().walk_steps;
    }
    // 22 mm aslant over squares of 10 mm and their diagonals, some of which the tool drags along.
    EXPECT_GT(steps, 0);
    EXPECT_LE(steps, 20);
    go(at + Vec3(0, 0, 0.1));  // far away
    go(at);
    EXPECT_EQ(done.back().tree_queries, 0);
    EXPECT_EQ(done.back().walk_steps, 0);
  }
  for (std::size_t k = 0; k < cycles[0].size(); ++k) {
    EXPECT_EQ(cycles[0][k].walk_steps, cycles[1][k].walk_steps);
    EXPECT_EQ(cycles[0][k].tree_queries, cycles[1][k].tree_queries);
  }
}

TEST(SegmentContact, IsRefusedWhereItCannotBe) {
  const auto refusal = [](const LiverSlab& slab) -> std::string {
    try {
      slab.make();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  LiverSlab other = slabOf();
  other.settings.method = "implicit_pcg";
  EXPECT_TRUE(test::contains(refusal(other), "contact.model = prescribed"));
  EXPECT_TRUE(test::contains(refusal(other), "choose method newton_bicgstab"));
  LiverSlab curved("newton_bicgstab", Eigen::Vector3i(2, 2, 2), "tet10");
  curved.settings.contact.model = "prescribed";
  EXPECT_TRUE(test::contains(refusal(curved), "choose anp or tet4"));
}

}  // namespace
}  // namespace palpate::tissue::segment_contact_test
