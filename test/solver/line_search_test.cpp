// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/line_search.h"

#include <gtest/gtest.h>

#include "palpate/fem/elasticity.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::solver::line_search_test {
namespace {

// Nodes drawn to where they are `moved`, but one that only a weak force draws, for ever.
class Drawn final : public fem::EnergyTerm {
 public:
  explicit Drawn(Points to) : to_(std::move(to)) {}

  double value(const Points& x) const override {
    const Points rest = (x - to_).rightCols(x.cols() - 1);
    return 0.5 * rest.squaredNorm() - kPull * x(0, 0);
  }
  double addGradient(const Points& x, Points* g) const override {
    g->rightCols(x.cols() - 1) += (x - to_).rightCols(x.cols() - 1);
    (*g)(0, 0) -= kPull;
    return value(x);
  }
  void addHessian(const Points&, fem::Tangent, fem::Stiffness*) const override {}

 private:
  static constexpr double kPull = 1e-6;  // [N]
  Points to_;
};

struct Search {
  const mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.1, 0.1, 0.1), Eigen::Vector3i::Constant(2));
  std::unique_ptr<fem::Elasticity> body =
      fem::makeElasticity("tet4", mesh,
                          fem::Composition::uniform(material::makeMaterial(
                              "linear", {{"young_modulus", {1e-12}}, {"poisson_ratio", {0.3}}})));
  const Points moved = mesh.points.colwise() + Vec3(0.02, 0.0, 0.01);
  Drawn drawn{moved};
  Potential potential{body.get(), {&drawn}, fem::FreeMask::Ones(3, mesh.numPoints()), 1.0};
  Points x = mesh.points, g;
  LineSearch search;

  bool run(const Points& d) {
    double value = potential.gradient(x, &g);
    return search.run(potential, d, &x, &g, &value);
  }
  // Times the edge of the block that a node went.
  double farthest() const { return (x - mesh.points).colwise().norm().maxCoeff() / 0.1; }
};

TEST(LineSearch, TakesTheWholeStepOfADirectionThatIsGood) {
  Search s;
  Points d = s.moved - s.x;
  d.col(0).setZero();
  ASSERT_TRUE(s.run(d));
  EXPECT_EQ(s.search.halvings(), 0);
  EXPECT_LT((s.x - s.moved).rightCols(s.x.cols() - 1).norm(), 1e-15);
}

TEST(LineSearch, StopsTheNodeThatFliesOffAndNoOther) {
  Search s;
  Points d = s.moved - s.x;
  d.col(0) = Vec3(1e5, 0.0, 0.0);
  ASSERT_TRUE(s.run(d));
  EXPECT_LT(s.farthest(), 4.0);
  EXPECT_GT(s.farthest(), 1.0);
  EXPECT_LT((s.x - s.moved).rightCols(s.x.cols() - 1).norm(), 1e-15);
}

// The others go uphill, and only the node that flies off goes down.
TEST(LineSearch, ShortensAllWhereItWouldGoUphillElse) {
  Search s;
  Points d = 1e-3 * (s.x - s.moved);
  d.col(0) = Vec3(1e5, 0.0, 0.0);
  const double before = s.potential.value(s.x);
  ASSERT_TRUE(s.run(d));
  EXPECT_LT(s.potential.value(s.x), before);
  EXPECT_LT(s.farthest(), 4.0);
  EXPECT_GT(s.farthest(), 1.0);
}

}  // namespace
}  // namespace palpate::solver::line_search_test
