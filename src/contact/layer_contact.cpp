// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/layer_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "palpate/base/number.h"
#include "palpate/contact/triangle_distance.h"

namespace palpate::contact {
namespace {

// phi and its derivatives.
struct Barrier {
  double value, slope, curvature;
};

Barrier ofQuotient(double y) {
  return {0.5 * (1.0 - y) * (1.0 - y) / y, 0.5 * (1.0 - 1.0 / (y * y)), 1.0 / (y * y * y)};
}

Barrier barrier(double y) {
  if (y >= LayerContact::kFloor) return ofQuotient(y);
  const Barrier at = ofQuotient(LayerContact::kFloor);
  const double d = y - LayerContact::kFloor;
  return {at.value + d * (at.slope + 0.5 * d * at.curvature), at.slope + d * at.curvature,
          at.curvature};
}

double meanEdgeOf(const Points& X, const Eigen::Matrix3Xi& triangles) {
  double sum = 0.0;
  for (const auto& t : triangles.colwise()) {
    for (int k = 0; k < 3; ++k) sum += (X.col(t[k]) - X.col(t[(k + 1) % 3])).norm();
  }
  return sum / (3.0 * static_cast<double>(triangles.cols()));
}

// Middles of the triangles, and how far their corners are from there.
void measure(const Points& x, const Eigen::Matrix3Xi& triangles, Points* middles,
             Eigen::VectorXd* sizes) {
  for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
    const Vec3 a = x.col(triangles(0, t)), b = x.col(triangles(1, t)), c = x.col(triangles(2, t));
    const Vec3 middle = (a + b + c) / 3.0;
    middles->col(t) = middle;
    (*sizes)[t] = std::sqrt(std::max(
        {(a - middle).squaredNorm(), (b - middle).squaredNorm(), (c - middle).squaredNorm()}));
  }
}

TrianglePoint nearest(const Points& x, int point, const Eigen::Vector3i& t) {
  return nearestOnTriangle(x.col(point), x.col(t[0]), x.col(t[1]), x.col(t[2]));
}

}  // namespace

LayerContact::LayerContact(const Points& X, const Eigen::Matrix3Xi& triangles,
                           const Eigen::VectorXd& areas, const LayerSettings& settings)
    : X_(X),
      triangles_(triangles),
      areas_(areas),
      settings_(settings),
      apart_(std::max(2.5 * meanEdgeOf(X, triangles), 2.0 * settings.most)),
      margin_(settings.most) {
  if (!(settings.least >= 0.0 && settings.least < settings.most)) {
    throw std::invalid_argument(
        "gap: least = " + formatNumber(settings.least) +
        " must be >= 0 and less than most = " + formatNumber(settings.most));
  }
  if (!(settings.pressure > 0.0)) throw std::invalid_argument("pressure must be > 0");
  middles_.resize(3, triangles.cols());
  sizes_.resize(triangles.cols());
  pairs_.reserve(static_cast<std::size_t>(32 * X.cols()));
}

void LayerContact::search(const Points& x) const {
  if (searched_at_.cols() == x.cols() &&
      !(4.0 * (x - searched_at_).colwise().squaredNorm().maxCoeff() > margin_ * margin_)) {
    return;
  }
  searched_at_ = x;
  find(x);
}

// By point, then by triangle, so that sums have one order whenever it was looked.
void LayerContact::find(const Points& x) const {
  pairs_.clear();
  if (!x.allFinite()) return;
  measure(x, triangles_, &middles_, &sizes_);
  for (int i = 0; i < static_cast<int>(x.cols()); ++i) {
    const Vec3 p = x.col(i);
    for (int t = 0; t < static_cast<int>(triangles_.cols()); ++t) {
      const double far = settings_.most + margin_ + sizes_[t];
      if ((middles_.col(t) - p).squaredNorm() > far * far) continue;
      const Vec3 at_rest = X_.col(i);
      if ((nearest(X_, i, triangles_.col(t)).point - at_rest).norm() < apart_) continue;
      pairs_.push_back({i, t});
    }
  }
}

// visit(pair, nearest point, distance) of those that are nearer than `reach`.
template <class Visit>
void LayerContact::forNear(const Points& x, double reach, const Visit& visit) const {
  search(x);
  for (const Pair& pair : pairs_) {
    const TrianglePoint near = nearest(x, pair.point, triangles_.col(pair.triangle));
    const double gap = (x.col(pair.point) - near.point).norm();
    if (gap < reach) visit(pair, near, gap);
  }
}

double LayerContact::value(const Points& x) const {
  const double width = settings_.most - settings_.least;
  double sum = 0.0;
  forNear(x, settings_.most, [&](const Pair& pair, const TrianglePoint&, double gap) {
    sum += areas_[pair.point] * settings_.pressure * width *
           barrier((gap - settings_.least) / width).value;
  });
  return sum;
}

double LayerContact::addGradient(const Points& x, Points* g) const {
  const double width = settings_.most - settings_.least;
  double sum = 0.0;
  forNear(x, settings_.most, [&](const Pair& pair, const TrianglePoint& near, double gap) {
    const Barrier phi = barrier((gap - settings_.least) / width);
    const double strength = areas_[pair.point] * settings_.pressure;
    sum += strength * width * phi.value;
    if (!(gap > 0.0)) return;  // no direction
    const Vec3 force = strength * phi.slope / gap * (x.col(pair.point) - near.point);
    g->col(pair.point) += force;
    for (int k = 0; k < 3; ++k) g->col(triangles_(k, pair.triangle)) -= near.weights[k] * force;
  });
  return sum;
}

// The distance depends on the corners less the point: its derivatives by the point are minus the
// sums of those by the corners.
void LayerContact::addHessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const {
  const double width = settings_.most - settings_.least;
  forNear(x, settings_.most, [&](const Pair& pair, const TrianglePoint& near, double gap) {
    if (!(gap > 0.0)) return;
    const Barrier phi = barrier((gap - settings_.least) / width);
    const double strength = areas_[pair.point] * settings_.pressure;
    const Vec3 n = (x.col(pair.point) - near.point) / gap;
    const Eigen::Vector4i nodes(pair.point, triangles_(0, pair.triangle),
                                triangles_(1, pair.triangle), triangles_(2, pair.triangle));
    K->addPoint<4>(nodes,
                   Eigen::Vector4d(1.0, -near.weights[0], -near.weights[1], -near.weights[2]),
                   strength / width * phi.curvature * n * n.transpose());
    if (tangent != fem::Tangent::kExact) return;
    Mat3 corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = x.col(nodes[k + 1]);
    const Eigen::Matrix<double, 9, 9> by_corners =
        strength * phi.slope * triangleDistanceHessian(corners, near, n, gap);
    Eigen::Matrix<double, 12, 12> H = Eigen::Matrix<double, 12, 12>::Zero();
    H.bottomRightCorner<9, 9>() = by_corners;
    for (int k = 0; k < 3; ++k) {
      H.topRightCorner<3, 9>() -= by_corners.middleRows<3>(3 * k);
    }
    H.bottomLeftCorner<9, 3>() = H.topRightCorner<3, 9>().transpose();
    for (int k = 0; k < 3; ++k) H.topLeftCorner<3, 3>() -= H.block<3, 3>(0, 3 * k + 3);
    K->add(nodes, H);
  });
}

double LayerContact::maxStep(const Points& x, const Points& d) const {
  const Vec3 together = d.rowwise().mean();
  const double longest = std::sqrt((d.colwise() - together).colwise().squaredNorm().maxCoeff());
  double part = 1.0;
  // Beyond that layers could meet that are no pairs yet.
  if (2.0 * longest > settings_.most) part = settings_.most / (2.0 * longest);
  forNear(x, settings_.most + margin_, [&](const Pair& pair, const TrianglePoint&, double gap) {
    double way = 0.0;
    for (int k = 0; k < 3; ++k) {
      way = std::max(way, (d.col(triangles_(k, pair.triangle)) - d.col(pair.point)).norm());
    }
    if (way * part > 0.5 * gap) part = 0.5 * gap / way;
  });
  return part;
}

double LayerContact::leastGap(const Points& x) const {
  double least = std::numeric_limits<double>::infinity();
  forNear(x, settings_.most,
          [&](const Pair&, const TrianglePoint&, double gap) { least = std::min(least, gap); });
  return least;
}

double LayerContact::largestSquare(const Eigen::VectorXd& masses) const {
  constexpr double kMaxPairs = 8.0;  // of a point, and as often it is a corner
  const double curvature =
      settings_.pressure / (settings_.most - settings_.least) * ofQuotient(kFloor).curvature;
  // Each pair has two ends that may go against each other.
  return 4.0 * kMaxPairs * curvature * areas_.cwiseQuotient(masses).maxCoeff();
}

}  // namespace palpate::contact
