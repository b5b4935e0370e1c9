// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/spline_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace palpate::mesh {
namespace {

using Weights = Eigen::Vector4d;

/// The four splines that overlap a point along one axis: index of the first, values and derivatives
/// by the local coordinate.
struct Axis {
  Eigen::Index first;
  double part;

  Axis(double place, int cells) {
    const double cell = std::clamp(std::floor(place), 0.0, cells - 1.0);
    first = static_cast<Eigen::Index>(cell);
    part = place - cell;
  }
  Weights values() const {
    const double u = part, v = 1.0 - u;
    return Weights(v * v * v, 4.0 - 3.0 * u * u * (2.0 - u), 4.0 - 3.0 * v * v * (2.0 - v),
                   u * u * u) /
           6.0;
  }
  Weights slopes() const {
    const double u = part, v = 1.0 - u;
    return 0.5 * Weights(-v * v, u * (3.0 * u - 4.0), v * (4.0 - 3.0 * v), u * u);
  }
  Weights curvatures() const {
    return Weights(1.0 - part, 3.0 * part - 2.0, 1.0 - 3.0 * part, part);
  }
};

// sum_bc wy[b] wz[c] row(b, c), with row(b, c) already summed along x.
template <class Row>
double sumOver(const Weights& wy, const Weights& wz, const Row& row) {
  double sum = 0.0;
  for (int c = 0; c < 4; ++c) {
    double plane = 0.0;
    for (int b = 0; b < 4; ++b) plane += wy[b] * row(b, c);
    sum += wz[c] * plane;
  }
  return sum;
}

// Solves c[i-1] + 4 c[i] + c[i+1] = 6 f[i] for the inner nodes of a line of n, with fixed ends; f
// becomes c.
void prefilter(Eigen::Index n, std::vector<double>* line, std::vector<double>* pivots) {
  std::vector<double>&f = *line, &p = *pivots;
  p[0] = 0.0;
  for (Eigen::Index i = 1; i + 1 < n; ++i) {
    p[i] = 1.0 / (4.0 - p[i - 1]);
    f[i] = (6.0 * f[i] - f[i - 1]) * p[i];
  }
  for (Eigen::Index i = n - 2; i > 0; --i) f[i] -= p[i] * f[i + 1];
}

}  // namespace

double SplineGrid::value(const Vec3& p) const {
  const Vec3 place = (p - box.low) / box.spacing;
  const Axis x(place.x(), box.cells.x()), y(place.y(), box.cells.y()), z(place.z(), box.cells.z());
  const Eigen::Index nx = box.cells.x() + 3, ny = box.cells.y() + 3;
  const Weights wx = x.values();
  return sumOver(y.values(), z.values(), [&](int b, int c) {
    return wx.dot(coefficients.segment<4>(x.first + nx * (y.first + b + ny * (z.first + c))));
  });
}

FieldPoint SplineGrid::at(const Vec3& p) const {
  const Vec3 place = (p - box.low) / box.spacing;
  const Axis x(place.x(), box.cells.x()), y(place.y(), box.cells.y()), z(place.z(), box.cells.z());
  const Eigen::Index nx = box.cells.x() + 3, ny = box.cells.y() + 3;
  const Weights x0 = x.values(), x1 = x.slopes(), x2 = x.curvatures();
  Eigen::Matrix4d rows, slopes, curvatures;  // sums along x for splines b along y, c along z
  for (int c = 0; c < 4; ++c) {
    for (int b = 0; b < 4; ++b) {
      const Weights row =
          coefficients.segment<4>(x.first + nx * (y.first + b + ny * (z.first + c)));
      rows(b, c) = x0.dot(row);
      slopes(b, c) = x1.dot(row);
      curvatures(b, c) = x2.dot(row);
    }
  }
  const Weights y0 = y.values(), y1 = y.slopes(), y2 = y.curvatures();
  const Weights z0 = z.values(), z1 = z.slopes(), z2 = z.curvatures();
  const double first = 1.0 / box.spacing, second = first * first;
  FieldPoint point;
  point.value = sumOver(y0, z0, rows);
  point.gradient =
      first * Vec3(sumOver(y0, z0, slopes), sumOver(y1, z0, rows), sumOver(y0, z1, rows));
  const double xy = sumOver(y1, z0, slopes), xz = sumOver(y0, z1, slopes),
               yz = sumOver(y1, z1, rows);
  point.hessian << sumOver(y0, z0, curvatures), xy, xz,  //
      xy, sumOver(y2, z0, rows), yz,                     //
      xz, yz, sumOver(y0, z2, rows);
  point.hessian *= second;
  return point;
}

SplineGrid interpolate(const GridBox& box, const Eigen::VectorXd& values) {
  const Eigen::Vector3i nodes = box.cells.array() + 1, splines = box.cells.array() + 3;
  SplineGrid grid{box, Eigen::VectorXd::Zero(SplineGrid::numCoefficients(box.cells))};
  const std::array<Eigen::Index, 3> stride = {1, splines.x(),
                                              Eigen::Index{splines.x()} * splines.y()};
  for (Eigen::Index k = 0, at = 0; k < nodes.z(); ++k) {
    for (Eigen::Index j = 0; j < nodes.y(); ++j, at += nodes.x()) {
      grid.coefficients.segment(1 + stride[1] * (j + 1) + stride[2] * (k + 1), nodes.x()) =
          values.segment(at, nodes.x());
    }
  }
  std::vector<double> line, pivots;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const Eigen::Index n = nodes[axis];
    line.resize(static_cast<std::size_t>(n));
    pivots.resize(line.size());
    for (Eigen::Index a = 0; a < splines[u]; ++a) {
      for (Eigen::Index b = 0; b < splines[v]; ++b) {
        double* begin = grid.coefficients.data() + stride[u] * a + stride[v] * b;
        for (Eigen::Index i = 0; i < n; ++i) line[i] = begin[stride[axis] * (i + 1)];
        prefilter(n, &line, &pivots);
        for (Eigen::Index i = 0; i < n; ++i) begin[stride[axis] * (i + 1)] = line[i];
        begin[0] = 2.0 * line[0] - line[1];
        begin[stride[axis] * (n + 1)] = 2.0 * line[n - 1] - line[n - 2];
      }
    }
  }
  return grid;
}

}  // namespace palpate::mesh
