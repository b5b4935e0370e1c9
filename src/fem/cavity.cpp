// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/fem/cavity.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "face_rule.h"
#include "face_volume.h"

namespace palpate::fem {
namespace {

// Whether each edge occurs once in each direction.
bool areClosed(const Eigen::MatrixXi& faces) {
  std::map<std::pair<int, int>, int> edges;
  for (Eigen::Index t = 0; t < faces.cols(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int a = faces(k, t), b = faces((k + 1) % 3, t);
      a < b ? ++edges[{a, b}] : --edges[{b, a}];
    }
  }
  return std::all_of(edges.begin(), edges.end(), [](const auto& e) { return e.second == 0; });
}

}  // namespace

CavityPressure::CavityPressure(const Points& X, Eigen::MatrixXi faces, const CavityContent& content)
    : faces_(std::move(faces)),
      content_(content),
      closed_(areClosed(faces_)),
      place_(static_cast<std::size_t>(X.cols()), -1) {
  if (resistsVolume() && !(closed_ && volume(X) > 0.0)) {
    throw std::invalid_argument("volume_stiffness: the faces enclose no cavity");
  }
  for (const int i : faces_.reshaped()) {
    if (place_[i] >= 0) continue;
    place_[i] = static_cast<int>(nodes_.size());
    nodes_.push_back(i);
  }
}

double CavityPressure::volume(const Points& x) const { return -volumeUnder(x, faces_); }

double CavityPressure::pressureAt(double volume) const {
  const double rest = factor_ * content_.pressure;
  if (!sealed_volume_) return rest;
  return rest - content_.volume_stiffness * (volume - *sealed_volume_) / *sealed_volume_;
}

double CavityPressure::excess(double volume) const {
  return pressureAt(volume) - (content_.balanced ? factor_ * content_.pressure : 0.0);
}

// The pressure is linear in V, so the work from V_0 is the mean of both ends times V - V_0.
double CavityPressure::value(const Points& x) const {
  const double V = volume(x), from = sealed_volume_.value_or(0.0);
  return -0.5 * (excess(from) + excess(V)) * (V - from);
}

double CavityPressure::addGradient(const Points& x, Points* g) const {
  const double V = volume(x), from = sealed_volume_.value_or(0.0);
  addVolumeGradient(x, faces_, excess(V), g);
  return -0.5 * (excess(from) + excess(V)) * (V - from);
}

void CavityPressure::addHessian(const Points& x, Tangent tangent, Stiffness* K) const {
  // This term is indefinite; only the exact tangent contains it.
  if (tangent == Tangent::kExact) addVolumeHessian(x, faces_, excess(volume(x)), K);
  if (!resistsVolume() || !sealed_volume_) return;
  slope_.setZero(3, static_cast<Eigen::Index>(nodes_.size()));
  for (const FacePoint& q : faceRule(faces_.rows())) {
    for (Eigen::Index t = 0; t < faces_.cols(); ++t) {
      const Vec3 area = q.weight * q.areaVector(x, faces_.col(t));
      for (Eigen::Index a = 0; a < faces_.rows(); ++a) {
        slope_.col(place_[faces_(a, t)]) -= q.N[a] * area;
      }
    }
  }
  K->addRankOne(nodes_, slope_, content_.volume_stiffness / *sealed_volume_);
}

double CavityPressure::largestSquare(const Points& X, const Eigen::VectorXd& masses) const {
  Points slope = Points::Zero(3, X.cols());
  addVolumeGradient(X, faces_, 1.0, &slope);
  double rank_one = 0.0;
  if (resistsVolume()) {
    for (const int i : nodes_) rank_one += slope.col(i).squaredNorm() / masses[i];
    rank_one *= content_.volume_stiffness / volume(X);
  }
  // Row sums of the second derivative's block norms bound its eigenvalues [Gershgorin 1931].
  Eigen::VectorXd row = Eigen::VectorXd::Zero(X.cols());
  for (const FacePoint& q : faceRule(faces_.rows())) {
    for (Eigen::Index t = 0; t < faces_.cols(); ++t) {
      const auto f = faces_.col(t);
      const double dr = q.weight * q.interpolate(X, f, q.dN_dr).norm();
      const double ds = q.weight * q.interpolate(X, f, q.dN_ds).norm();
      const Eigen::VectorXd moved = ds * q.dN_dr.cwiseAbs() + dr * q.dN_ds.cwiseAbs();
      for (Eigen::Index a = 0; a < faces_.rows(); ++a) {
        row[f[a]] += 0.5 * (std::abs(q.N[a]) * moved.sum() + q.N.cwiseAbs().sum() * moved[a]);
      }
    }
  }
  double follower = 0.0;
  for (const int i : nodes_) follower = std::max(follower, row[i] / masses[i]);
  return rank_one + (actsAtRest() ? std::abs(content_.pressure) * follower : 0.0);
}

}  // namespace palpate::fem
