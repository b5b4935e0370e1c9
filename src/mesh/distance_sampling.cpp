// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <vector>

#include "cgal/inside.h"
#include "palpate/mesh/distance_grid.h"
#include "palpate/mesh/size_field.h"

namespace palpate::mesh {
namespace {

// Margin of the box beyond the surface: splines are less accurate at their ends.
constexpr double kMarginCells = 4.0, kMarginOfDiagonal = 0.02;
constexpr int kErrorPoints = 20000;
constexpr int kMostRounds = 6;
// Refinement stops when this times the spacing is below the memory limit's spacing [-].
constexpr double kWorthwhile = 0.99;

/// Exact signed distance of a surface.
class ExactDistance {
 public:
  explicit ExactDistance(const SurfaceMesh& surface) : distance_(surface), inside_(surface) {}

  double unsignedAt(const Vec3& p) const { return distance_(p); }
  double signAt(const Vec3& p) const { return inside_.contains(p) ? -1.0 : 1.0; }
  double operator()(const Vec3& p) const { return signAt(p) * distance_(p); }

 private:
  SurfaceDistance distance_;
  cgal::Inside inside_;
};

GridBox boxAround(const SurfaceMesh& surface, double least_margin, double spacing) {
  const Vec3 low = surface.points.rowwise().minCoeff(), high = surface.points.rowwise().maxCoeff();
  const double margin =
      std::max(kMarginCells * spacing, kMarginOfDiagonal * (high - low).norm()) + least_margin;
  GridBox box;
  box.spacing = spacing;
  const Vec3 wanted = ((high - low).array() + 2.0 * margin) / spacing;
  box.cells = wanted.array().ceil().cast<int>();
  box.low = 0.5 * (low + high) - 0.5 * spacing * box.cells.cast<double>();
  return box;
}

double megabytesOf(const SurfaceMesh& surface, double margin, double spacing) {
  return 1e-6 * sizeof(double) *
         (boxAround(surface, margin, spacing).cells.array() + 3).cast<double>().prod();
}

// Finest spacing within the memory limit.
double finestSpacing(const SurfaceMesh& surface, double coarsest,
                     const DistanceGridSettings& settings) {
  const auto fits = [&](double spacing) {
    return megabytesOf(surface, settings.margin, spacing) <= settings.memory;
  };
  double fine = coarsest, coarse = coarsest;
  while (!fits(coarse)) coarse *= 2.0;
  while (fits(fine)) fine *= 0.5;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (fine + coarse);
    (fits(middle) ? coarse : fine) = middle;
  }
  return coarse;
}

// Two points lie on the same side if the sum of their distances exceeds their separation. So few
// points need the exact sign.
Eigen::VectorXd sample(const ExactDistance& exact, const GridBox& box,
                       const std::function<void(double)>& progress) {
  const Eigen::Vector3i n = box.cells.array() + 1;
  const std::array<Eigen::Index, 3> stride = {1, n.x(), Eigen::Index{n.x()} * n.y()};
  const double apart = box.spacing * (1.0 + 1e-9);
  Eigen::VectorXd values(box.numNodes());
  Eigen::Index at = 0;
  for (int k = 0; k < n.z(); ++k) {
    progress(static_cast<double>(k) / n.z());
    for (int j = 0; j < n.y(); ++j) {
      for (int i = 0; i < n.x(); ++i, ++at) {
        const Vec3 p = box.node(i, j, k);
        const double d = exact.unsignedAt(p);
        const std::array<int, 3> before = {i, j, k};
        double sign = 0.0;
        for (int axis = 0; axis < 3 && sign == 0.0; ++axis) {
          if (before[static_cast<std::size_t>(axis)] == 0) continue;
          const double other = values[at - stride[static_cast<std::size_t>(axis)]];
          if (d + std::abs(other) > apart) sign = other < 0.0 ? -1.0 : 1.0;
        }
        values[at] = (sign != 0.0 ? sign : exact.signAt(p)) * d;
      }
    }
  }
  return values;
}

/// Reproducible points near the surface, uniformly distributed over it.
class PointsNear {
 public:
  PointsNear(const SurfaceMesh& surface, double within) : surface_(surface), within_(within) {
    areas_.reserve(static_cast<std::size_t>(surface.triangles.cols()));
    double sum = 0.0;
    for (Eigen::Index t = 0; t < surface.triangles.cols(); ++t) {
      const Mat3 c = corners(t);
      sum += 0.5 * (c.col(1) - c.col(0)).cross(Vec3(c.col(2) - c.col(0))).norm();
      areas_.push_back(sum);
    }
  }

  Vec3 next() {
    const double area = uniform() * areas_.back();
    const auto found = std::upper_bound(areas_.begin(), areas_.end(), area);
    const auto last = static_cast<std::ptrdiff_t>(areas_.size()) - 1;
    const Mat3 c = corners(std::min(found - areas_.begin(), last));
    const double root = std::sqrt(uniform()), along = uniform();
    const Vec3 on_surface = c * Vec3(1.0 - root, root * (1.0 - along), root * along);
    const Vec3 aside(uniform() - 0.5, uniform() - 0.5, uniform() - 0.5);
    return on_surface + within_ * uniform() * aside.stableNormalized();
  }

 private:
  // The standard defines the generator's bits, but not those of distributions.
  double uniform() { return static_cast<double>(random_() >> 11) * 0x1.0p-53; }
  Mat3 corners(Eigen::Index t) const {
    Mat3 c;
    for (int k = 0; k < 3; ++k) c.col(k) = surface_.points.col(surface_.triangles(k, t));
    return c;
  }

  const SurfaceMesh& surface_;
  double within_;
  std::vector<double> areas_;  // cumulative over triangles
  std::mt19937_64 random_{1};
};

void measureError(const ExactDistance& exact, DistanceGrid* grid) {
  PointsNear points(grid->surface, grid->field.box.spacing);
  double largest = 0.0, sum = 0.0;
  for (int i = 0; i < kErrorPoints; ++i) {
    const Vec3 p = points.next();
    const double error = grid->value(p) - exact(p);
    largest = std::max(largest, std::abs(error));
    sum += error * error;
  }
  grid->largest_error = largest;
  grid->rms_error = std::sqrt(sum / kErrorPoints);
}

void findDeepest(const Eigen::VectorXd& values, DistanceGrid* grid) {
  const GridBox& box = grid->field.box;
  Eigen::Index at = 0;
  grid->inscribed_radius = -values.minCoeff(&at);
  const Eigen::Index nx = box.cells.x() + 1, ny = box.cells.y() + 1;
  grid->deepest = box.node(static_cast<int>(at % nx), static_cast<int>(at / nx % ny),
                           static_cast<int>(at / (nx * ny)));
}

}  // namespace

DistanceGrid makeDistanceGrid(const SurfaceMesh& surface, const DistanceGridSettings& settings,
                              const MeshingProgress& progress) {
  const double diagonal =
      (surface.points.rowwise().maxCoeff() - surface.points.rowwise().minCoeff()).norm();
  double spacing = diagonal / settings.cells;
  const double finest = finestSpacing(surface, spacing, settings);
  spacing = std::max(spacing, finest);
  const ExactDistance exact(surface);
  DistanceGrid grid;
  grid.surface = surface;
  for (int round = 1;; ++round) {
    const std::string stage = "sampling the distance, round " + std::to_string(round);
    const GridBox box = boxAround(surface, settings.margin, spacing);
    const Eigen::VectorXd values = sample(exact, box, [&](double part) {
      if (progress) progress(stage, part);
    });
    grid.field = interpolate(box, values);
    findDeepest(values, &grid);
    measureError(exact, &grid);
    // The error is proportional to the spacing at edges.
    const double ratio = settings.error / grid.largest_error;
    const bool exact_enough = ratio >= 1.0 && grid.inscribed_radius > 0.0;
    grid.limited = !exact_enough;
    if (exact_enough || spacing * kWorthwhile <= finest || round == kMostRounds) break;
    spacing = std::max(finest, spacing * std::clamp(0.9 * ratio, 0.3, 0.8));
  }
  if (!(grid.inscribed_radius > 0.0)) {
    throw std::invalid_argument(
        "the surface is too thin for its distance to be sampled: no point "
        "of the finest grid that memory allows is inside");
  }
  if (progress) progress("done", 1.0);
  return grid;
}

}  // namespace palpate::mesh
