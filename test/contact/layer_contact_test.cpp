// SPDX-License-Identifier: GPL-3.0-or-later
// Layers of a folded sheet: derivatives against differences, forces without a sum and a moment, who
// meets whom, and how near they come.
#include "palpate/contact/layer_contact.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <stdexcept>

#include "support/random.h"

namespace palpate::contact::layer_contact_test {
namespace {

constexpr int kColumns = 5, kRows = 12;
constexpr double kSpacing = 0.004, kGap = 0.0015;

Points flat() {
  Points X = Points::Zero(3, kColumns * kRows);
  for (int j = 0; j < kRows; ++j) {
    for (int i = 0; i < kColumns; ++i) X.col(j * kColumns + i) << i * kSpacing, j * kSpacing, 0.0;
  }
  return X;
}

Eigen::Matrix3Xi triangles() {
  Eigen::Matrix3Xi all(3, 2 * (kColumns - 1) * (kRows - 1));
  Eigen::Index t = 0;
  for (int j = 0; j + 1 < kRows; ++j) {
    for (int i = 0; i + 1 < kColumns; ++i) {
      const int a = j * kColumns + i;
      all.col(t++) << a, a + 1, a + kColumns;
      all.col(t++) << a + 1, a + kColumns + 1, a + kColumns;
    }
  }
  return all;
}

// The upper half turned over onto the lower one, `gap` above it and a little aside.
Points folded(double gap) {
  Points x = flat();
  for (int k = kColumns * kRows / 2; k < kColumns * kRows; ++k) {
    x.col(k) << x(0, k) + 0.0011, (kRows - 1) * kSpacing - x(1, k) + 0.0007, gap;
  }
  return x;
}

LayerContact layers(double least = 5e-4, double most = 2e-3, double pressure = 300.0) {
  return LayerContact(flat(), triangles(),
                      Eigen::VectorXd::Constant(kColumns * kRows, kSpacing * kSpacing),
                      {least, most, pressure});
}

TEST(LayerContact, GradientIsThatOfTheEnergy) {
  const LayerContact contact = layers();
  const Points x = folded(kGap) + test::Random(3).points(kColumns * kRows, 2e-4);
  Points g = Points::Zero(3, x.cols());
  EXPECT_EQ(contact.addGradient(x, &g), contact.value(x));
  EXPECT_GT(g.norm(), 1e-4);
  const double h = 1e-8;
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    Points there = x, here = x;
    there.data()[k] += h;
    here.data()[k] -= h;
    const double slope = (contact.value(there) - contact.value(here)) / (2.0 * h);
    EXPECT_NEAR(g.data()[k], slope, 1e-5 * g.cwiseAbs().maxCoeff()) << k;
  }
}

TEST(LayerContact, HessianIsThatOfTheGradient) {
  const LayerContact contact = layers();
  const Points x = folded(kGap) + test::Random(4).points(kColumns * kRows, 2e-4);
  const Eigen::Index n = x.cols();
  fem::Stiffness K(fem::BlockMatrix(static_cast<int>(n), {}));
  contact.addHessian(x, fem::Tangent::kExact, &K);
  const double h = 1e-8;
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    Points d = Points::Zero(3, n), Kd = d, up = d, down = d;
    d.data()[k] = 1.0;
    K.multiply(d, &Kd);
    contact.addGradient(x + h * d, &up);
    contact.addGradient(x - h * d, &down);
    EXPECT_LT((Kd - (up - down) / (2.0 * h)).norm(), 1e-4 * (Kd.norm() + 1.0)) << k;
  }
}

TEST(LayerContact, HasAProjectedTangentWithoutNegativeDirections) {
  const LayerContact contact = layers();
  const Points x = folded(kGap);
  fem::Stiffness K(fem::BlockMatrix(static_cast<int>(x.cols()), {}));
  contact.addHessian(x, fem::Tangent::kProjected, &K);
  test::Random random(5);
  for (int k = 0; k < 50; ++k) {
    const Points d = random.points(x.cols(), 1.0);
    Points Kd;
    K.multiply(d, &Kd);
    EXPECT_GE(d.cwiseProduct(Kd).sum(), 0.0);
  }
}

TEST(LayerContact, KeepsMomentumAndItsMoment) {
  const LayerContact contact = layers();
  const Points x = folded(kGap) + test::Random(6).points(kColumns * kRows, 3e-4);
  Points g = Points::Zero(3, x.cols());
  contact.addGradient(x, &g);
  Vec3 moment = Vec3::Zero();
  for (Eigen::Index i = 0; i < x.cols(); ++i) moment += Vec3(x.col(i)).cross(Vec3(g.col(i)));
  EXPECT_LT(g.rowwise().sum().norm(), 1e-14 * g.cwiseAbs().sum());
  EXPECT_LT(moment.norm(), 1e-14 * 0.05 * g.cwiseAbs().sum());
}

// Whatever side they turn to one another.
TEST(LayerContact, PushesLayersApartThatAreNear) {
  const LayerContact contact = layers();
  for (const double side : {1.0, -1.0}) {
    Points g = Points::Zero(3, kColumns * kRows);
    contact.addGradient(folded(side * kGap), &g);
    EXPECT_LT(side * g(2, kColumns * kRows - 3), 0.0);  // the force is minus that
    EXPECT_GT(side * g(2, 2), 0.0);
  }
  EXPECT_EQ(contact.value(folded(2.1e-3)), 0.0);
  EXPECT_GT(contact.value(folded(1.9e-3)), 0.0);
  EXPECT_NEAR(contact.leastGap(folded(kGap)), kGap, 1e-12);
}

TEST(LayerContact, LeavesAFlatAndAGentlyBentSheetAlone) {
  const LayerContact contact = layers();
  EXPECT_EQ(contact.value(flat()), 0.0);
  Points bent = flat();
  for (Eigen::Index i = 0; i < bent.cols(); ++i) {
    const double angle = bent(1, i) / 0.01;
    bent.col(i) << bent(0, i), 0.01 * std::sin(angle), 0.01 - 0.01 * std::cos(angle);
  }
  EXPECT_EQ(contact.value(bent), 0.0);
}

// The energy does not depend on where the pairs were looked for.
TEST(LayerContact, GivesTheSameBitsHoweverItGotThere) {
  const LayerContact fresh = layers(), moved = layers();
  for (int k = 0; k < 40; ++k) moved.value(folded(4e-3 - 6e-5 * k));
  Points a = Points::Zero(3, kColumns * kRows), b = a;
  const Points x = folded(1.61e-3);
  EXPECT_EQ(fresh.addGradient(x, &a), moved.addGradient(x, &b));
  EXPECT_EQ(a, b);
}

TEST(LayerContact, LetsNoLayerGoMoreThanHalfWay) {
  const LayerContact contact = layers();
  const Points x = folded(kGap);
  Points d = Points::Zero(3, x.cols());
  for (Eigen::Index i = x.cols() / 2; i < x.cols(); ++i) d(2, i) = -0.004;
  EXPECT_LE(contact.maxStep(x, d) * 0.004, 0.5 * kGap);
  EXPECT_EQ(contact.maxStep(flat(), Points::Constant(3, x.cols(), 0.01)), 1.0);
}

TEST(LayerContact, RefusesGapsThatAreNone) {
  EXPECT_THROW(layers(2e-3, 2e-3), std::invalid_argument);
  EXPECT_THROW(layers(-1e-3, 2e-3), std::invalid_argument);
  EXPECT_THROW(layers(1e-3, 2e-3, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::contact::layer_contact_test
