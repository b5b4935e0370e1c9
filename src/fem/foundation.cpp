// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/fem/foundation.h"

#include <algorithm>

#include "face_rule.h"

namespace palpate::fem {
namespace {

// The matrix k_n n n^T + k_t (I - n n^T).
Mat3 across(double normal, double tangential, const Vec3& n) {
  return tangential * Mat3::Identity() + (normal - tangential) * n * n.transpose();
}

}  // namespace

Foundation::Foundation(const Points& X, const Eigen::MatrixXi& faces,
                       const FoundationConstants& constants)
    : constants_(constants), damped_(constants.damped()) {
  Eigen::VectorXd area = Eigen::VectorXd::Zero(X.cols());
  Points normal = Points::Zero(3, X.cols());
  for (const FacePoint& q : faceRule(faces.rows())) {
    for (Eigen::Index t = 0; t < faces.cols(); ++t) {
      const Vec3 vector = q.weight * q.areaVector(X, faces.col(t));
      for (Eigen::Index a = 0; a < faces.rows(); ++a) {
        area[faces(a, t)] += q.N[a] * vector.norm();
        normal.col(faces(a, t)) += q.N[a] * vector;
      }
    }
  }
  // Corners of straight quadratic faces have zero area up to rounding.
  const double least = 1e-9 * area.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    if (!(area[i] > least)) continue;
    const Vec3 n = normal.col(i).normalized();
    nodes_.push_back({static_cast<int>(i), area[i], X.col(i),
                      area[i] * across(constants.normal, constants.tangential, n),
                      area[i] * across(constants.normal_damping, constants.tangential_damping, n)});
  }
  begin_.assign(nodes_.size(), Vec3::Zero());
}

void Foundation::beginStep(double h, const Points& x) {
  h_ = h;
  if (!damps()) return;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    begin_[k] = x.col(nodes_[k].node) - nodes_[k].anchor - offset_;
  }
}

double Foundation::value(const Points& x) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const Vec3 e = x.col(nodes_[k].node) - nodes_[k].anchor - offset_;
    sum += 0.5 * e.dot(nodes_[k].spring * e);
    if (!damps()) continue;
    const Vec3 way = e - begin_[k];
    sum += 0.5 / h_ * way.dot(nodes_[k].damper * way);
  }
  return sum;
}

double Foundation::addGradient(const Points& x, Points* g) const {
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const Node& n = nodes_[k];
    const Vec3 e = x.col(n.node) - n.anchor - offset_;
    g->col(n.node) += n.spring * e;
    if (damps()) g->col(n.node) += n.damper * (e - begin_[k]) / h_;
  }
  return value(x);
}

void Foundation::addHessian(const Points& /*x*/, Tangent /*tangent*/, Stiffness* K) const {
  for (const Node& n : nodes_) {
    K->add(n.node, n.node, damps() ? Mat3(n.spring + n.damper / h_) : n.spring);
  }
}

void Foundation::addHeldDirections(std::vector<HeldDirection>* held) const {
  for (const Node& n : nodes_) {
    for (int c = 0; c < 3; ++c) {
      const Vec3 direction = n.spring.col(c);
      if (direction.norm() > 0.0) held->push_back({n.node, direction.normalized()});
    }
  }
}

double Foundation::largestSquare(const Eigen::VectorXd& masses) const {
  double largest = 0.0;
  for (const Node& n : nodes_) largest = std::max(largest, n.area / masses[n.node]);
  return std::max(constants_.normal, constants_.tangential) * largest;
}

}  // namespace palpate::fem
