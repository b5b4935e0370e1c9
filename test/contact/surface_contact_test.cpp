// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/surface_contact.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "contact/surface_pass.h"
#include "palpate/mesh/tet_mesh.h"
#include "support/random.h"

namespace palpate::contact::surface_contact_test {
namespace {

const Penalty kLaw{3.0e6, 2.0e-3};

// The surface of a block, whose points are also all that it has.
struct Block {
  Block(const Vec3& size, const Eigen::Vector3i& cells, const Vec3& low) {
    const mesh::TetMesh mesh = mesh::boxMesh(size, cells);
    triangles = mesh::boundaryTriangles(mesh.tets);
    X = mesh.points.colwise() + low;
    surface = makeContactSurface(X, triangles);
  }
  Points X;
  Eigen::Matrix3Xi triangles;
  std::shared_ptr<const ContactSurface> surface;
};

Points both(const Points& a, const Points& b) {
  Points x(3, a.cols() + b.cols());
  x << a, b;
  return x;
}

// Two blocks with displaced nodes, and so with dents, one rotated and pushed into the other.
class SurfacesTogether : public ::testing::Test {
 protected:
  SurfacesTogether()
      : a(Vec3(0.04, 0.04, 0.02), {4, 4, 2}, Vec3(0.0, 0.0, 0.021)),
        b(Vec3(0.05, 0.05, 0.02), {6, 6, 2}, Vec3(-0.004, -0.006, 0.0)),
        contact(a.surface, b.surface, kLaw) {
    const Points moved = a.X + random.points(a.X.cols(), 1.5e-3);
    const Mat3 turn = Eigen::AngleAxisd(0.05, Vec3(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
    x = both((turn * moved).colwise() - Vec3(0.0, 0.0, 0.003),
             b.X + random.points(b.X.cols(), 1.5e-3));
    // A pit, and what reaches below its bottom.
    const Eigen::Index tip = nearest(a, Vec3(0.01, 0.01, 0.021));
    const Eigen::Index pit = a.X.cols() + nearest(b, Vec3(0.0127, 0.0107, 0.02));
    x.col(pit) = Vec3(0.0095, 0.0102, 0.014);
    x.col(tip) = Vec3(0.01, 0.01, 0.0125);
    contact.search(x, 1e-3);
  }
  static Eigen::Index nearest(const Block& block, const Vec3& place) {
    Eigen::Index found = 0;
    (block.X.colwise() - place).colwise().squaredNorm().minCoeff(&found);
    return found;
  }
  Points gradientAt(const Points& at) const {
    Points g = Points::Zero(3, at.cols());
    contact.addGradient(at, &g);
    return g;
  }

  test::Random random;
  Block a, b;
  SurfaceContact contact;
  Points x;
};

TEST_F(SurfacesTogether, TouchOnFacesEdgesAndCornersOfDents) {
  std::array<int, 3> found{};
  MovingSurface first{a.surface, 0, {}}, second{b.surface, static_cast<int>(a.X.cols()), {}};
  for (MovingSurface* s : {&first, &second}) {
    s->fixed->tree().fit(s->part(x), s->fixed->triangles(), &s->boxes);
  }
  SurfacePass one(&first, &second), other(&second, &first);
  for (SurfacePass* pass : {&one, &other}) {
    pass->search(x, 1e-3, std::numeric_limits<double>::infinity());
    pass->forTouches(x, {}, 0.0, [&](const SurfaceTouch& touch, const SurfaceSample&) {
      ++found[static_cast<std::size_t>(touch.near.feature)];
    });
  }
  std::printf("faces %d, edges %d, corners %d\n", found[0], found[1], found[2]);
  EXPECT_GT(*std::min_element(found.begin(), found.end()), 0);
}

// What was far away is not looked at again before it can be near: on ways slow and fast, together
// and towards each other, and after a leap.
TEST_F(SurfacesTogether, AreFoundByASearchThatGoesOnAsByANewOne) {
  Vec3 v = Vec3::Zero();
  int most = 0, least = contact.numCandidates();
  for (int k = 0; k < 300; ++k) {
    v = 0.9 * v + random.vector(k % 100 < 50 ? 2e-4 : 1e-3);
    x.leftCols(a.X.cols()).colwise() += v;
    x.colwise() += random.vector(2e-3);
    x += random.points(x.cols(), 1e-5);
    // Back over the other one.
    const Vec3 apart = x.leftCols(a.X.cols()).rowwise().mean() - (a.X).rowwise().mean() -
                       x.rightCols(b.X.cols()).rowwise().mean() + b.X.rowwise().mean();
    if (apart.norm() > 0.008) x.leftCols(a.X.cols()).colwise() -= apart, v.setZero();
    const double way = k % 3 == 0 ? 2e-4 : 1e-3;
    contact.search(x, way);
    SurfaceContact other(a.surface, b.surface, kLaw);
    other.search(x, way);
    ASSERT_EQ(contact.numCandidates(), other.numCandidates()) << k;
    Points g = Points::Zero(3, x.cols());
    other.addGradient(x, &g);
    ASSERT_EQ(gradientAt(x), g) << k;
    most = std::max(most, other.numCandidates());
    least = std::min(least, other.numCandidates());
  }
  EXPECT_LT(least, most / 4);
}

TEST_F(SurfacesTogether, GradientIsThatOfTheEnergy) {
  const Points g = gradientAt(x);
  constexpr double h = 1e-8;
  Points sum = g;
  EXPECT_EQ(contact.addGradient(x, &sum), contact.value(x));
  double most = 0.0;
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    for (int c = 0; c < 3; ++c) {
      Points up = x, down = x;
      up(c, i) += h;
      down(c, i) -= h;
      const double slope = (contact.value(up) - contact.value(down)) / (2.0 * h);
      EXPECT_NEAR(g(c, i), slope, 1e-6 * g.norm()) << i;
      most = std::max(most, std::abs(slope));
    }
  }
  EXPECT_GT(most, 0.0);
}

TEST_F(SurfacesTogether, StiffnessIsTheChangeOfTheGradient) {
  fem::Stiffness K(fem::BlockMatrix(static_cast<int>(x.cols()), {}));
  contact.addHessian(x, fem::Tangent::kExact, &K);
  constexpr double h = 1e-9;
  for (int trial = 0; trial < 20; ++trial) {
    const Points d = random.points(x.cols(), 1.0);
    Points product = Points::Zero(3, x.cols());
    K.multiply(d, &product);
    const Points slope = (gradientAt(x + h * d) - gradientAt(x - h * d)) / (2.0 * h);
    EXPECT_LT((product - slope).norm(), 1e-5 * slope.norm());
  }
}

TEST_F(SurfacesTogether, StiffnessHasAConvexPart) {
  fem::Stiffness K(fem::BlockMatrix(static_cast<int>(x.cols()), {}));
  contact.addHessian(x, fem::Tangent::kConvexTerms, &K);
  const Eigen::Index n = x.size();
  Eigen::MatrixXd dense(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    Points unit = Points::Zero(3, x.cols()), column = unit;
    unit.reshaped()[k] = 1.0;
    K.multiply(unit, &column);
    dense.col(k) = column.reshaped();
  }
  EXPECT_LT((dense - dense.transpose()).norm(), 1e-12 * dense.norm());
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense, Eigen::EigenvaluesOnly).eigenvalues();
  EXPECT_GT(values.maxCoeff(), 0.0);
  EXPECT_GT(values.minCoeff(), -1e-10 * values.maxCoeff());
}

TEST_F(SurfacesTogether, ExertNoForceAndNoMomentInAll) {
  const Points g = gradientAt(x);
  double moments = 0.0;
  Vec3 moment = Vec3::Zero();
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const Vec3 one = Vec3(x.col(i)).cross(Vec3(g.col(i)));
    moment += one;
    moments += one.norm();
  }
  EXPECT_LT(g.rowwise().sum().norm(), 1e-14 * g.colwise().norm().sum());
  EXPECT_LT(moment.norm(), 1e-13 * moments);
}

// Each is the first one, and moved with all.
TEST_F(SurfacesTogether, AreTheSameEitherWayAndAnywhere) {
  SurfaceContact turned(b.surface, a.surface, kLaw);
  const Eigen::Index n = a.X.cols(), m = b.X.cols();
  turned.search(both(x.rightCols(m), x.leftCols(n)), 1e-3);
  const double value = contact.value(x);
  EXPECT_NEAR(turned.value(both(x.rightCols(m), x.leftCols(n))), value, 1e-13 * value);
  const Points moved = (random.rotation() * x).colwise() + Vec3(0.1, 0.2, 0.3);
  contact.search(moved, 1e-3);
  EXPECT_NEAR(contact.value(moved), value, 1e-9 * value);
}

// What a search with little to spare finds is all that there is.
TEST_F(SurfacesTogether, AreFoundWhileNoPointGoesFartherThanTold) {
  SurfaceContact all(a.surface, b.surface, kLaw);
  for (const double way : {1e-4, 5e-4, 1.5e-3}) {
    contact.search(x, way);
    for (int trial = 0; trial < 10; ++trial) {
      Points moved = x;
      for (Eigen::Index i = 0; i < x.cols(); ++i) {
        moved.col(i) += 0.999 * way * random.vector(1.0).normalized();
      }
      all.search(moved, 0.02);
      Points g = Points::Zero(3, x.cols()), h = g;
      contact.addGradient(moved, &g);
      all.addGradient(moved, &h);
      EXPECT_TRUE(contact.holds(moved));
      EXPECT_EQ(g, h);
      EXPECT_GT(g.norm(), 0.0);
    }
    Points far = x;
    far.col(3) += 1.1 * way * Vec3::UnitX();
    EXPECT_FALSE(contact.holds(far));
  }
}

TEST_F(SurfacesTogether, OverlapAtRestWithoutForce) {
  const Block inside(Vec3(0.03, 0.03, 0.02), {3, 3, 2}, Vec3(0.003, 0.002, 0.016));
  SurfaceContact overlapping(inside.surface, b.surface, kLaw);
  Points rest = both(inside.X, b.X);
  overlapping.search(rest, 1e-3);
  EXPECT_EQ(overlapping.value(rest), 0.0);
  rest.leftCols(inside.X.cols()).row(2).array() -= 0.001;
  overlapping.search(rest, 1e-3);
  EXPECT_GT(overlapping.value(rest), 0.0);
}

// A step does not carry a point through; what is far does not shorten it.
TEST_F(SurfacesTogether, DoNotPassThroughInAStep) {
  const Block above(Vec3(0.03, 0.03, 0.01), {3, 3, 1}, Vec3(0.003, 0.002, 0.03));
  SurfaceContact falling(above.surface, b.surface, kLaw);
  const Points start = both(above.X, b.X);
  Points down = Points::Zero(3, start.cols());
  down.leftCols(above.X.cols()).row(2).setConstant(-0.05);
  falling.search(start, 0.06);
  // 10 mm apart, and half of the lower one's half thickness in.
  EXPECT_NEAR(falling.maxStep(start, down), (0.01 + 0.25 * 0.01) / 0.05, 0.06);
  EXPECT_LT(falling.maxStep(start, down), (0.01 + 0.01) / 0.05);
  EXPECT_EQ(falling.maxStep(start, -down), 1.0);
  falling.search(start, 0.01);  // nor farther than one looked
  EXPECT_NEAR(falling.maxStep(start, down), 0.2, 1e-12);
}

// The nodes of a mesh on another one get what a uniform pressure gives them: to 2 % within the
// patch. At its border a sample of the larger one counts with all of its area or not at all: in all
// that is half of a strip along the border, half a spacing wide, at most.
TEST(FlatSurfaces, ShareAPressureEvenly) {
  const Block lower(Vec3(0.06, 0.06, 0.02), {7, 6, 2}, Vec3(-0.011, -0.012, 0.0)),
      upper(Vec3(0.04, 0.04, 0.02), {5, 5, 2}, Vec3(0.0, 0.0, 0.02));
  SurfaceContact contact(upper.surface, lower.surface, Penalty{3.0e8, 1.0e-4});
  constexpr double kDepth = 2e-5;
  Points x = both(upper.X, lower.X);
  x.leftCols(upper.X.cols()).row(2).array() -= kDepth;
  contact.search(x, 1e-3);
  Points g = Points::Zero(3, x.cols());
  contact.addGradient(x, &g);
  const double pressure = Penalty{3.0e8, 1.0e-4}.pressure(kDepth, 0.01);
  EXPECT_NEAR(g.leftCols(upper.X.cols()).row(2).sum(), -pressure * 0.04 * 0.04,
              0.5 * pressure * 4.0 * 0.04 * 0.5 * 0.00334);
  double worst = 0.0;
  int inside = 0;
  for (Eigen::Index i = 0; i < upper.X.cols(); ++i) {
    const Vec3 p = upper.X.col(i);
    const bool within =
        p.z() == 0.02 && std::min(p.x(), p.y()) > 0.012 && std::max(p.x(), p.y()) < 0.028;
    if (!within) continue;
    double area = 0.0;
    for (Eigen::Index t = 0; t < upper.triangles.cols(); ++t) {
      const Eigen::Vector3i c = upper.triangles.col(t);
      if ((c.array() != static_cast<int>(i)).all()) continue;
      const Vec3 e = upper.X.col(c[1]) - upper.X.col(c[0]),
                 f = upper.X.col(c[2]) - upper.X.col(c[0]);
      area += e.cross(f).norm() / 6.0;
    }
    worst = std::max(worst, std::abs(-g(2, i) / (pressure * area) - 1.0));
    ++inside;
  }
  std::printf("%d nodes, worst by %.2f %%\n", inside, 100.0 * worst);
  RecordProperty("worst", std::to_string(worst));
  EXPECT_EQ(inside, 4);
  EXPECT_LT(worst, 0.02);
}

}  // namespace
}  // namespace palpate::contact::surface_contact_test
