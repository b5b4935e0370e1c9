// SPDX-License-Identifier: GPL-3.0-or-later
// Umbrella operators between the particles of an octree, and what becomes of these.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "model_variants.h"
#include "support/contains.h"
#include "support/random.h"
#include "tissue/models/sampled/sampled_body.h"

namespace palpate::tissue::sampled_elasticity_test {
namespace {

constexpr double kMu = 2.0e3, kLambda = 3.0e3;

mesh::TetMesh cube() { return mesh::boxMesh(Vec3(0.05, 0.05, 0.05), Eigen::Vector3i(5, 5, 5)); }

material::Moduli moduli() {
  material::Moduli moduli{};
  moduli.mu = kMu;
  moduli.kappa = kLambda + 2.0 / 3.0 * kMu;
  return moduli;
}

// Of the particle in the middle of 5^3, for displacements X -> d.
template <class Field>
Vec3 forceInTheMiddle(const std::string& weights, const Field& field) {
  ParticleTree tree(cube(), Pose::Identity(), 0.01, 1);
  const std::vector<int> leaves = tree.leafList();
  Umbrella umbrella(moduli(), 1000.0, weights);
  umbrella.build(tree, leaves, {});
  Points d(3, static_cast<Eigen::Index>(leaves.size())), f;
  for (std::size_t k = 0; k < leaves.size(); ++k) {
    const Vec3 X = tree.particles()[static_cast<std::size_t>(leaves[k])].X;
    d.col(static_cast<Eigen::Index>(k)) = field(X - Vec3::Constant(0.025));
  }
  Vec3 anchors;
  umbrella.forces(d, &f, &anchors);
  return f.col(62);  // of 125
}

TEST(Umbrella, TakesAThirdOfTheLaplacianAsPublished) {
  // d = z^2 e_x: Laplacian 2 e_x, no divergence; of 6 sides and 12 diagonals sqrt(2) as long, the
  // mean of |l| n_x^2 n_z^2 over that of |l| is sqrt(2)/(6 + 12 sqrt(2)).
  const Vec3 shear =
      forceInTheMiddle("published", [](const Vec3& X) { return Vec3(X.z() * X.z(), 0.0, 0.0); });
  const double mixed = std::sqrt(2.0) / (6.0 + 12.0 * std::sqrt(2.0));
  EXPECT_NEAR(shear.x() / 1e-6, 2.0 * (kMu / 3.0 + (kLambda + kMu) * mixed), 1e-6);
  EXPECT_LT(shear.tail<2>().norm(), 1e-12);
}

// Of d = z^2 e_z the right force is 2 (lambda + 2 mu), with Poisson's ratio 1/4 where it is larger,
// 2.4 E. The lattice is not quite the same in all directions: of |l| n_z^4 it has 0.2103 for 1/5.
TEST(Umbrella, IsOfElasticitysSizeWhereItIsConsistent) {
  const Vec3 press =
      forceInTheMiddle("consistent", [](const Vec3& X) { return Vec3(0.0, 0.0, X.z() * X.z()); });
  const double young = kMu * (3.0 * kLambda + 2.0 * kMu) / (kLambda + kMu);
  EXPECT_NEAR(press.z() / 1e-6, 2.4 * young, 0.06 * 2.4 * young);
  const Vec3 published =
      forceInTheMiddle("published", [](const Vec3& X) { return Vec3(0.0, 0.0, X.z() * X.z()); });
  EXPECT_LT(published.z(), 0.3 * press.z());
}

TEST(Umbrella, OfPairsIsOppositeWhereItIsConsistent) {
  ParticleTree tree(cube(), Pose::Identity(), 0.01, 2);
  std::vector<int> parted;
  tree.refine(tree.leafAt(Vec3(0.01, 0.02, 0.03)), &parted);
  const std::vector<int> leaves = tree.leafList();
  const Points d = test::Random(4).points(static_cast<Eigen::Index>(leaves.size()), 1e-3);
  for (const bool consistent : {true, false}) {
    Umbrella umbrella(moduli(), 1000.0, consistent ? "consistent" : "published");
    umbrella.build(tree, leaves, {});
    Points f;
    Vec3 anchors;
    umbrella.forces(d, &f, &anchors);
    const double sum = f.rowwise().sum().norm() / f.norm();
    if (consistent) {
      EXPECT_LT(sum, 1e-14);
    } else {
      EXPECT_GT(sum, 1e-3);
    }
  }
}

TEST(ParticleTree, FillsTheOrganOnceWhateverIsParted) {
  ParticleTree tree(cube(), Pose::Identity(), 0.0125, 4);
  test::Random random(9);
  std::vector<int> parted;
  for (int k = 0; k < 40; ++k) {
    const std::vector<int> leaves = tree.leafList();
    const int leaf = leaves[static_cast<std::size_t>(random.uniform(0.0, 0.999) *
                                                     static_cast<double>(leaves.size()))];
    if (tree.particles()[static_cast<std::size_t>(leaf)].num_children > 0) {
      tree.refine(leaf, &parted);
    }
    double volume = 0.0;
    for (const int p : tree.leafList()) {
      volume += tree.particles()[static_cast<std::size_t>(p)].volume;
      for (const int n : tree.neighbours(p)) {
        const int apart = tree.particles()[static_cast<std::size_t>(p)].level -
                          tree.particles()[static_cast<std::size_t>(n)].level;
        ASSERT_LE(std::abs(apart), 1);
        const std::vector<int> back = tree.neighbours(n);
        ASSERT_TRUE(std::binary_search(back.begin(), back.end(), p));
      }
    }
    ASSERT_NEAR(volume, 1.25e-4, 1e-15);
  }
  EXPECT_GT(parted.size(), 40U);
}

// A momentum that is parted and joined again stays what it is.
TEST(SampledBody, KeepsItsMomentumWhileItAdapts) {
  SamplingSettings settings;
  settings.coarsest = 0.0125;
  settings.levels = 3;
  settings.refine_above = 1e-4;
  settings.coarsen_below = 5e-5;
  const mesh::TetMesh mesh = cube();
  SampledBody body(mesh, Pose::Identity(), mesh.points, {}, moduli(), 1000.0, settings);
  const auto bendIt = [&](double size) {
    for (std::size_t k = 0; k < body.leaves().size(); ++k) {
      const Vec3 X = body.tree().particles()[static_cast<std::size_t>(body.leaves()[k])].X;
      body.d.col(static_cast<Eigen::Index>(k)) =
          size * std::exp(-(X - Vec3(0.02, 0.02, 0.05)).squaredNorm() / 1e-4) * Vec3::UnitZ();
    }
  };
  body.v = test::Random(2).points(body.v.cols(), 0.1);
  const Vec3 momentum = body.v * body.masses;
  const Eigen::Index before = body.v.cols();
  bendIt(0.003);
  for (int k = 0; k < 4; ++k) {
    if (!body.adapt()) break;
    EXPECT_LT((body.v * body.masses - momentum).norm(), 1e-14);
  }
  EXPECT_GT(body.v.cols(), before + 8);
  body.d.setZero();
  while (body.adapt()) EXPECT_LT((body.v * body.masses - momentum).norm(), 1e-14);
  EXPECT_EQ(body.v.cols(), before);
}

// The weight of a block, against finite elements of its Young's modulus; Poisson's ratio 1/4.
TEST(SampledElasticity, SagsAsElasticityDoesAndAsPublishedMore) {
  const material::Material law =
      material::makeMaterial("neo_hookean", {{"young_modulus", {6e3}}, {"poisson_ratio", {0.25}}});
  const auto sag = [&](const test::ModelVariant& variant) {
    test::OrganSketch organ = test::variantBlock(variant);
    organ.solid.law = law;
    const auto tissue = test::makeVariant(variant, organ, test::variantSettings());
    const Points X = organ.mesh.points, x = tissue->positions();
    double sum = 0.0;
    int count = 0;
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
      if (X(2, i) < 0.0299 || (X.col(i).head<2>() - Eigen::Vector2d(0.03, 0.03)).norm() > 0.012) {
        continue;
      }
      sum += X(2, i) - x(2, i);
      ++count;
    }
    return sum / count;
  };
  const double elements = sag(test::ModelVariant{"fem", "fem", {}, {}});
  test::ModelVariant sampled{"sampled", "sampled_elasticity", {}, {}};
  sampled.sampling.levels = 1;
  for (const double spacing : {0.01, 0.005}) {
    sampled.sampling.coarsest = spacing;
    const double particles = sag(sampled);
    RecordProperty("sag over that of elements", std::to_string(particles / elements));
    EXPECT_NEAR(particles, elements, 0.15 * elements);
  }
  sampled.sampling.weights = "published";
  EXPECT_GT(sag(sampled), 2.0 * elements);
}

// A cycle that stability asks for more steps of than it may have is not gone through, and says so.
TEST(SampledElasticity, SaysThatACycleIsTooLong) {
  const test::ModelVariant sampled{"sampled", "sampled_elasticity", {}, {}};
  auto settings = test::variantSettings();
  settings.skip.sleeping = false;
  const auto tissue = test::makeVariant(sampled, test::variantBlock(sampled), settings);
  const Points x = tissue->positions();
  EXPECT_TRUE(tissue->step({}, 0.01).ok());
  EXPECT_EQ(tissue->step({}, 1e3).status, solver::SolveStatus::kIterationLimit);
  EXPECT_LT((tissue->positions() - x).norm(), 1e-6);
}

// Smaller particles take shorter sub-steps. Where a cycle would then take more than there are, all
// later ones would end where they begin.
TEST(SampledElasticity, PartsNoParticlesThatACycleHasNoSubStepsFor) {
  test::ModelVariant sampled{"sampled", "sampled_elasticity", {}, {}};
  sampled.sampling.coarsest = 0.015;
  sampled.sampling.levels = 2;
  auto settings = test::variantSettings();
  settings.gravity.setZero();
  settings.skip.sleeping = false;
  const auto particles = [](const tissue::TissueModel& tissue) {
    int count = 0;
    double step = 0.0;
    const std::string note = tissue.notes().front();
    EXPECT_EQ(std::sscanf(note.c_str(), "%d particles at rest, steps of %lf", &count, &step), 2);
    return std::make_pair(count, step);
  };
  const test::OrganSketch organ = test::variantBlock(sampled);
  const auto parts = test::makeVariant(sampled, organ, settings);
  const auto [at_rest, sub_step] = particles(*parts);
  settings.step = 15000 * sub_step;
  const auto whole = test::makeVariant(sampled, organ, settings);
  test::Visit fast(0.008, 0.15), slow(0.008, 0.15);
  double most_force = 0.0;
  for (int k = 0; k < 30; ++k) {
    parts->step({fast.next()}, 0.01);
    const tissue::TissueStep& out = whole->step({slow.next()}, settings.step);
    ASSERT_EQ(out.status, solver::SolveStatus::kConverged) << k;
    for (const auto& contact : out.contacts) most_force += contact.force_W.norm();
    if (k == 14) {
      ASSERT_GT(particles(*parts).first, at_rest);
    }
    ASSERT_EQ(particles(*whole).first, at_rest);
  }
  EXPECT_GT(most_force, 0.01);
  EXPECT_LT((whole->positions() - organ.mesh.points).cwiseAbs().maxCoeff(), 1e-6);
}

// A bound of the velocity's change that asks for more of them than there are is not kept, and told;
// the tissue moves all the same.
TEST(SampledElasticity, MovesWhereVelocitiesChangeByMoreThanTheyMay) {
  test::ModelVariant sampled{"sampled", "sampled_elasticity", {}, {}};
  sampled.sampling.coarsest = 0.015;
  sampled.sampling.levels = 1;
  sampled.sampling.max_velocity_change = 1e-6;
  auto settings = test::variantSettings();
  settings.gravity.setZero();
  settings.skip.sleeping = false;
  const test::OrganSketch organ = test::variantBlock(sampled);
  const auto tissue = test::makeVariant(sampled, organ, settings);
  Points moved = organ.mesh.points;
  moved.row(2) *= 0.9;
  tissue->setPositions(0, moved, Points::Zero(3, moved.cols()));
  const double before = (tissue->positions() - organ.mesh.points).norm();
  EXPECT_EQ(tissue->step({}, 0.01).status, solver::SolveStatus::kIterationLimit);
  for (int k = 0; k < 200; ++k) tissue->step({}, 0.01);
  EXPECT_LT((tissue->positions() - organ.mesh.points).norm(), 0.01 * before);
}

TEST(SampledElasticity, RefusesAStepThatIsAlwaysTooLong) {
  const test::ModelVariant sampled{"sampled", "sampled_elasticity", {}, {}};
  auto settings = test::variantSettings();
  settings.step = 1e3;
  try {
    test::makeVariant(sampled, test::variantBlock(sampled), settings);
    FAIL() << "taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(test::contains(error.what(), "solver.step = 1000 s")) << error.what();
    EXPECT_TRUE(test::contains(error.what(), "at most 20000")) << error.what();
  }
}

}  // namespace
}  // namespace palpate::tissue::sampled_elasticity_test
