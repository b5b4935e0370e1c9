// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/distance_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "mesh/surfaces.h"
#include "support/concave_surfaces.h"
#include "support/random.h"

namespace palpate::mesh::distance_grid_test {
namespace {

/// Distance to a box from `low` to `high` from outside of it.
double toBox(const Vec3& low, const Vec3& high, const Vec3& p) {
  return (p - p.cwiseMax(low).cwiseMin(high)).norm();
}

// Known exactly: outside the U is three boxes; inside, what is left of a box around it and of one
// in its opening.
double toU(const Vec3& p) {
  const Vec3 size(0.015, 0.005, 0.015), thick(0.005, 0.005, 0.005);
  const double outside = std::min({toBox(Vec3::Zero(), Vec3(size.x(), size.y(), thick.z()), p),
                                   toBox(Vec3::Zero(), Vec3(thick.x(), size.y(), size.z()), p),
                                   toBox(Vec3(0.010, 0.0, 0.0), size, p)});
  if (outside > 0.0) return outside;
  const double to_faces = std::min(p.minCoeff(), (size - p).minCoeff());
  return -std::min(to_faces, toBox(Vec3(0.005, -1.0, 0.005), Vec3(0.010, 1.0, 1.0), p));
}

double toRing(const Vec3& p) { return std::hypot(std::hypot(p.x(), p.y()) - 0.010, p.z()) - 0.003; }

struct Known {
  const char* name;
  SurfaceMesh surface;
  std::function<double(const Vec3&)> distance;
  double facets;  // by how much the triangles are off the known surface [m]
};

std::vector<Known> knownShapes() {
  // Chords of 2 pi / n are 1 - cos(pi / n) of the radius inside: 3 um and 4 um.
  return {{"U", test::uSurface(), toU, 1e-12},
          {"ring", test::ringSurface(0.010, 0.003, 192, 96), toRing, 8e-6}};
}

Vec3 near(const SurfaceMesh& surface, double spread, test::Random* random) {
  const auto t = static_cast<Eigen::Index>(
      random->uniform(0.0, static_cast<double>(surface.triangles.cols())));
  Vec3 weights = random->vector(1.0).cwiseAbs();
  weights /= weights.sum();
  Vec3 p = Vec3::Zero();
  for (int k = 0; k < 3; ++k) p += weights[k] * surface.points.col(surface.triangles(k, t));
  return p + random->vector(spread);
}

// Cubic splines through values with a kink miss it by less than half a cell.
TEST(DistanceGrid, IsAsNearToTheExactDistanceAsItSays) {
  for (const Known& shape : knownShapes()) {
    DistanceGridSettings settings;
    settings.error = 1e-2;  // the first grid will do
    const DistanceGrid grid = makeDistanceGrid(shape.surface, settings);
    const double h = grid.field.box.spacing;
    EXPECT_NEAR(
        h,
        (shape.surface.points.rowwise().maxCoeff() - shape.surface.points.rowwise().minCoeff())
                .norm() /
            64,
        1e-9);
    EXPECT_FALSE(grid.limited);
    EXPECT_LT(grid.largest_error, 0.5 * h) << shape.name;
    EXPECT_LT(grid.rms_error, 0.1 * h) << shape.name;
    test::Random random;
    double largest = 0.0, sum = 0.0;
    int inside = 0;
    constexpr int kPoints = 5000;
    for (int n = 0; n < kPoints; ++n) {
      const Vec3 p = near(shape.surface, 0.5 * h, &random);
      const double error = grid.value(p) - shape.distance(p);
      inside += shape.distance(p) < 0.0;
      largest = std::max(largest, std::abs(error));
      sum += error * error;
    }
    EXPECT_GT(inside, kPoints / 4);
    // Fewer points: they find no more, but the few that lie where it is worst are others.
    EXPECT_LT(largest, 1.5 * grid.largest_error + shape.facets) << shape.name;
    EXPECT_LT(std::sqrt(sum / kPoints), 1.5 * grid.rms_error + shape.facets) << shape.name;
    std::cout << shape.name << ": cells of " << 1e3 * h << " mm, largest error "
              << 1e6 * grid.largest_error << " um, rms " << 1e6 * grid.rms_error
              << " um; of others " << 1e6 * largest << ", " << 1e6 * std::sqrt(sum / kPoints)
              << "\n";
  }
}

TEST(DistanceGrid, IsRefinedUntilTheErrorIsAllowedOrMemoryIsFull) {
  DistanceGridSettings settings;
  settings.cells = 24;
  settings.error = 1e-2;
  const DistanceGrid coarse = makeDistanceGrid(test::hookSurface(), settings);
  settings.error = 0.3 * coarse.largest_error;
  const DistanceGrid fine = makeDistanceGrid(test::hookSurface(), settings);
  EXPECT_FALSE(fine.limited);
  EXPECT_LE(fine.largest_error, settings.error);
  EXPECT_LT(fine.field.box.spacing, 0.6 * coarse.field.box.spacing);
  settings.memory = 4e-6 * sizeof(double) * static_cast<double>(coarse.field.coefficients.size());
  settings.error = 1e-9;
  const DistanceGrid full = makeDistanceGrid(test::hookSurface(), settings);
  EXPECT_TRUE(full.limited);
  const double bytes = 1e-6 * sizeof(double) * static_cast<double>(full.field.coefficients.size());
  EXPECT_LE(bytes, settings.memory);
  EXPECT_GT(bytes, 0.7 * settings.memory);
}

TEST(DistanceGrid, KnowsItsDeepestPoint) {
  const DistanceGrid ring = makeDistanceGrid(test::ringSurface(0.010, 0.003, 96, 48), {});
  // The middle line is at most half a diagonal of a cube away from a node.
  EXPECT_LT(ring.inscribed_radius, 0.003);
  EXPECT_GT(ring.inscribed_radius, 0.003 - 0.87 * ring.field.box.spacing - 1e-5);
  EXPECT_NEAR(ring.value(ring.deepest), -ring.inscribed_radius, 1e-12);
}

// In the box, outside of it, and next to where cubes of the grid meet.
TEST(DistanceGrid, DerivativesAreThoseOfTheValue) {
  for (const Known& shape : knownShapes()) {
    const DistanceGrid grid = makeDistanceGrid(shape.surface, {});
    const Vec3 middle = 0.5 * (grid.field.box.low + grid.field.box.high());
    const double cube = grid.field.box.spacing, h = 1e-4 * cube;
    test::Random random;
    int outside = 0;
    for (int n = 0; n < 2000; ++n) {
      Vec3 p = n % 2 == 0 ? near(shape.surface, cube, &random) : Vec3(middle + random.vector(0.03));
      const Vec3 beyond = (grid.field.box.low - p).cwiseMax(p - grid.field.box.high());
      if (beyond.cwiseAbs().minCoeff() < 2.0 * h) continue;  // a kink
      outside += beyond.maxCoeff() > 0.0;
      const FieldPoint at = grid.at(p);
      EXPECT_EQ(at.value, grid.value(p));
      EXPECT_EQ(at.hessian, at.hessian.transpose());
      for (int k = 0; k < 3; ++k) {
        const Vec3 step = h * Vec3::Unit(k);
        const FieldPoint plus = grid.at(p + step), minus = grid.at(p - step);
        EXPECT_NEAR(at.gradient[k], (plus.value - minus.value) / (2.0 * h), 1e-6) << shape.name;
        // A second derivative changes by some 1 / cube from cube to cube.
        EXPECT_LT((at.hessian.col(k) - (plus.gradient - minus.gradient) / (2.0 * h)).norm() * cube,
                  2e-3)
            << shape.name;
      }
    }
    EXPECT_GT(outside, 300);
  }
}

TEST(DistanceGrid, BeyondItsBoxIsNoMoreThanTheDistanceAndContinuous) {
  for (const Known& shape : knownShapes()) {
    const DistanceGrid grid = makeDistanceGrid(shape.surface, {});
    const GridBox& box = grid.field.box;
    const Vec3 middle = 0.5 * (box.low + box.high()), half = 0.5 * (box.high() - box.low);
    // Half a cell, as above: the notches of the shapes reach the box.
    const double splines = 0.5 * box.spacing + shape.facets;
    test::Random random;
    for (int n = 0; n < 3000; ++n) {
      Vec3 p = middle + random.vector(1.0).cwiseProduct(half);
      p[n % 3] = n % 2 == 0 ? box.low[n % 3] : box.high()[n % 3];
      EXPECT_LE(grid.value(p), shape.distance(p) + splines) << shape.name;
      const Vec3 out = 1e-9 * (p - middle).normalized();
      EXPECT_NEAR(grid.value(p + out), grid.value(p - out), 1e-8);
      for (const double far : {1.01, 1.5, 10.0, 1000.0}) {
        const Vec3 q = middle + far * (p - middle);
        EXPECT_LE(grid.value(q), shape.distance(q) + splines) << shape.name << far;
        EXPECT_GE(grid.value(q), 0.5 * shape.distance(q)) << shape.name << far;
      }
    }
  }
}

TEST(DistanceGrid, SaysHowFarItIs) {
  double last = 0.0;
  int calls = 0;
  makeDistanceGrid(test::uSurface(), {}, [&](const std::string& stage, double part) {
    EXPECT_FALSE(stage.empty());
    EXPECT_GE(part, 0.0);
    EXPECT_LE(part, 1.0);
    ++calls;
    last = part;
  });
  EXPECT_GT(calls, 10);
  EXPECT_EQ(last, 1.0);
}

TEST(DistanceGrid, IsTheSameBitsEachTimeAndRefusesAFoil) {
  const DistanceGrid a = makeDistanceGrid(test::hookSurface(), {}),
                     b = makeDistanceGrid(test::hookSurface(), {});
  EXPECT_EQ(a.field.coefficients, b.field.coefficients);
  EXPECT_EQ(a.largest_error, b.largest_error);
  SurfaceMesh foil = test::uSurface();
  foil.points.row(1) *= 1e-6;
  EXPECT_THROW(makeDistanceGrid(foil, {64, 1e-4, 1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::mesh::distance_grid_test
