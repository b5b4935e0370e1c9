// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/point_change.h"

#include <gtest/gtest.h>

#include <random>

#include "fem/shape_functions.h"
#include "palpate/mesh/nested_mesh.h"

namespace palpate::fem::point_change_test {
namespace {

using mesh::TetMesh;

// Values at the integration points, in the order of the elements.
struct Values {
  Eigen::VectorXd at;

  double integral(const std::vector<double>& volumes) const { return sum(volumes, at); }
  double meanSquare(const std::vector<double>& volumes) const {
    return sum(volumes, at.cwiseAbs2());
  }

 private:
  static double sum(const std::vector<double>& volumes, const Eigen::VectorXd& what) {
    const Eigen::Index points = what.size() / static_cast<Eigen::Index>(volumes.size());
    double total = 0.0;
    for (Eigen::Index i = 0; i < what.size(); ++i) {
      total +=
          volumes[static_cast<std::size_t>(i / points)] / static_cast<double>(points) * what[i];
    }
    return total;
  }
};

class PointChanges : public ::testing::TestWithParam<int> {
 protected:
  PointChanges() : nested_(blockFor(GetParam())) {}

  static TetMesh blockFor(int points) {
    const TetMesh block = mesh::boxMesh(Vec3(0.12, 0.1, 0.06), {6, 5, 3});
    return points == 4 ? mesh::toQuadratic(block) : block;
  }
  std::vector<double> volumes() const {
    std::vector<double> all;
    const TetMesh& mesh = nested_.mesh();
    for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
      all.push_back(mesh::signedVolume(mesh.points, mesh.tets.col(t)));
    }
    return all;
  }
  Points places() const {
    const TetMesh& mesh = nested_.mesh();
    Points places(3, GetParam() * mesh.numTets());
    for (Eigen::Index i = 0; i < places.cols(); ++i) {
      Eigen::Vector4d w = Eigen::Vector4d::Constant(0.25);
      if (GetParam() == 4) w = Tetrahedron<10>::point(static_cast<int>(i % 4));
      places.col(i).setZero();
      for (int k = 0; k < 4; ++k) {
        places.col(i) += w[k] * mesh.points.col(mesh.tets(k, i / GetParam()));
      }
    }
    return places;
  }
  // What becomes of values when the mesh suits a tool at p.
  Values goOn(const Values& old, const Vec3& p) {
    const std::vector<double> before = volumes();
    const auto change = nested_.adapt(
        nested_.mesh().points, [&](const Vec3& at) { return 0.004 + 0.5 * (at - p).norm(); }, {});
    EXPECT_TRUE(change);
    const PointChange from(*change, GetParam(), before);
    Values values{Eigen::VectorXd::Zero(GetParam() * nested_.mesh().numTets())};
    for (Eigen::Index i = 0; i < values.at.size(); ++i) {
      const int e = static_cast<int>(i) / GetParam(), q = static_cast<int>(i) % GetParam();
      for (const PointChange::Source& s : from.sources(e, q)) {
        values.at[i] += s.weight * old.at[GetParam() * s.element + s.point];
      }
    }
    return values;
  }
  Values noise() const {
    std::mt19937 random(4);
    std::normal_distribution<double> normal(0.0, 1.0);
    Values values{Eigen::VectorXd(GetParam() * nested_.mesh().numTets())};
    for (double& value : values.at) value = normal(random);
    return values;
  }

  mesh::NestedMesh nested_;
};

TEST_P(PointChanges, KeepIntegralsAndNoMeanSquareGrows) {
  Values now = noise();
  const double integral = now.integral(volumes());
  double mean_square = now.meanSquare(volumes());
  for (const double x : {0.02, 0.05, 0.08, 0.5}) {
    const double before = mean_square;
    now = goOn(now, Vec3(x, 0.04, 0.06));
    mean_square = now.meanSquare(volumes());
    EXPECT_NEAR(now.integral(volumes()), integral, 1e-12 * 0.12 * 0.1 * 0.06);
    EXPECT_LE(mean_square, before * (1.0 + 1e-12)) << x;
  }
}

TEST_P(PointChanges, GiveBackWhatWasSplit) {
  const Values coarse = noise();
  const Values fine = goOn(coarse, Vec3(0.05, 0.04, 0.06));
  EXPECT_GT(2 * fine.at.size(), 3 * coarse.at.size());
  const Values back = goOn(fine, Vec3(0.5, 0.04, 0.06));
  ASSERT_EQ(back.at.size(), coarse.at.size());
  EXPECT_LT((back.at - coarse.at).cwiseAbs().maxCoeff(), 1e-14);
}

// Split and joined: those of one point cannot show it.
TEST_P(PointChanges, KeepLinearFields) {
  if (GetParam() == 1) return;
  const Vec3 slope(3.0, -2.0, 5.0);
  const auto field = [&] { return Values{places().transpose() * slope}; };
  Values now = field();
  for (const double x : {0.02, 0.08, 0.5}) {
    now = goOn(now, Vec3(x, 0.04, 0.06));
    EXPECT_LT((now.at - field().at).cwiseAbs().maxCoeff(), 1e-15) << x;
  }
}

TEST_P(PointChanges, CopyWhatDoesNotChangeAndRefuseOtherElements) {
  const std::vector<double> before = volumes();
  const auto change = nested_.adapt(
      nested_.mesh().points,
      [](const Vec3& at) { return 0.004 + 0.5 * (at - Vec3(0.12, 0.1, 0.06)).norm(); }, {});
  const PointChange from(*change, GetParam(), before);
  int copies = 0;
  for (int e = 0; e < static_cast<int>(change->tets.size()); ++e) {
    copies += from.sources(e, 0).isCopy();
    if (from.sources(e, 0).isCopy()) {
      EXPECT_EQ(from.sources(e, 0).begin()->weight, 1.0);
    }
  }
  EXPECT_GT(copies, 100);
  EXPECT_THROW(PointChange(*change, 5 - GetParam(), before), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(OfElements, PointChanges, ::testing::Values(1, 4));

}  // namespace
}  // namespace palpate::fem::point_change_test
