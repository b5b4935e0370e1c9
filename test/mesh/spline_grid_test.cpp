// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/spline_grid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random.h"

namespace palpate::mesh::spline_grid_test {
namespace {

const GridBox kBox{Vec3(0.1, -0.2, 0.3), 0.05, Eigen::Vector3i(9, 7, 11)};

template <class Function>
SplineGrid splineOf(const Function& f, const GridBox& box = kBox) {
  Eigen::VectorXd values(box.numNodes());
  Eigen::Index at = 0;
  for (int k = 0; k <= box.cells.z(); ++k) {
    for (int j = 0; j <= box.cells.y(); ++j) {
      for (int i = 0; i <= box.cells.x(); ++i) values[at++] = f(box.node(i, j, k));
    }
  }
  return interpolate(box, values);
}

double wave(const Vec3& p) {
  return std::sin(7.0 * p.x() + 2.0) * std::cos(5.0 * p.y()) * std::exp(p.z());
}

Vec3 within(const GridBox& box, test::Random* random) {
  const Vec3 part = 0.5 * (random->vector(1.0) + Vec3::Ones());
  return box.low + part.cwiseProduct(box.high() - box.low);
}

TEST(SplineGrid, GoesThroughTheValuesAndIsExactForPlanes) {
  const SplineGrid spline = splineOf(wave);
  for (int k = 0; k <= kBox.cells.z(); ++k) {
    for (int j = 0; j <= kBox.cells.y(); ++j) {
      for (int i = 0; i <= kBox.cells.x(); ++i) {
        EXPECT_NEAR(spline.value(kBox.node(i, j, k)), wave(kBox.node(i, j, k)), 1e-13);
      }
    }
  }
  const Vec3 slope(1.0, -2.0, 3.0);
  const SplineGrid plane = splineOf([&](const Vec3& p) { return 5.0 + slope.dot(p); });
  test::Random random;
  for (int n = 0; n < 100; ++n) {
    const Vec3 p = within(kBox, &random);
    const FieldPoint at = plane.at(p);
    EXPECT_NEAR(at.value, 5.0 + slope.dot(p), 1e-13);
    EXPECT_LT((at.gradient - slope).norm(), 1e-11);
    EXPECT_LT(at.hessian.norm(), 1e-9);
  }
}

TEST(SplineGrid, DerivativesAreThoseOfTheValueAcrossCubesToo) {
  const SplineGrid spline = splineOf(wave);
  test::Random random;
  constexpr double h = 1e-6;
  for (int n = 0; n < 300; ++n) {
    Vec3 p = within({kBox.low + Vec3::Constant(0.01), 0.04, kBox.cells}, &random);
    // Every other one on the face between cubes.
    if (n % 2 == 0) p[n % 3] = kBox.node(3, 3, 3)[n % 3];
    const FieldPoint at = spline.at(p);
    EXPECT_EQ(at.value, spline.value(p));
    for (int k = 0; k < 3; ++k) {
      const FieldPoint plus = spline.at(p + h * Vec3::Unit(k)),
                       minus = spline.at(p - h * Vec3::Unit(k));
      EXPECT_NEAR(at.gradient[k], (plus.value - minus.value) / (2.0 * h), 1e-8);
      // The third derivative, some 7^3, jumps from cube to cube.
      EXPECT_LT((at.hessian.col(k) - (plus.gradient - minus.gradient) / (2.0 * h)).norm(), 1e-3);
    }
  }
}

// de Boor 1978, theorem XII.1: the error goes with the fourth power of the spacing; here away from
// the ends, where natural ones cost two orders.
TEST(SplineGrid, ErrorGoesWithTheFourthPowerOfTheSpacing) {
  const auto error = [](int refined) {
    const GridBox box{kBox.low, kBox.spacing / refined, refined * kBox.cells};
    const SplineGrid spline = splineOf(wave, box);
    const Vec3 middle = 0.5 * (box.low + box.high());
    test::Random random;
    double largest = 0.0;
    for (int n = 0; n < 500; ++n) {
      const Vec3 p = middle + 0.1 * (within(kBox, &random) - middle);
      largest = std::max(largest, std::abs(spline.value(p) - wave(p)));
    }
    return largest;
  };
  EXPECT_GT(error(2) / error(4), 12.0);
}

}  // namespace
}  // namespace palpate::mesh::spline_grid_test
