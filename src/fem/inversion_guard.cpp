// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/fem/inversion_guard.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpate::fem {
namespace {

constexpr double kFrom = InversionGuard::kLeast;
constexpr double kParabolaFrom = 0.1 * kFrom;

// b and its derivatives by J.
struct Barrier {
  double value, slope, curvature;
};

Barrier ofLogarithm(double J) {
  const double t = kFrom - J, log = std::log(J / kFrom);
  return {-t * t * log, 2.0 * t * log - t * t / J, -2.0 * log + 4.0 * t / J + t * t / (J * J)};
}

Barrier barrier(double J) {
  if (J >= kParabolaFrom) return ofLogarithm(J);
  const Barrier from = ofLogarithm(kParabolaFrom);
  const double d = J - kParabolaFrom;
  return {from.value + d * (from.slope + 0.5 * d * from.curvature), from.slope + d * from.curvature,
          from.curvature};
}

Mat3 cross(const Vec3& v) {
  Mat3 m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

// Columns: derivatives of the determinant by the three edges.
Mat3 cofactors(const Mat3& e) {
  Mat3 c;
  c << e.col(1).cross(e.col(2)), e.col(2).cross(e.col(0)), e.col(0).cross(e.col(1));
  return c;
}

// Converts derivatives by edges into derivatives by corners; edge i is corner i + 1 - corner 0.
Eigen::Matrix<double, 3, 4> byCorners(const Mat3& by_edges) {
  Eigen::Matrix<double, 3, 4> g;
  g << -by_edges.rowwise().sum(), by_edges;
  return g;
}

// Adds the skew second derivative of the triple product by the corners a and b, and its parts for
// corner 0, where both edges begin.
void addPair(int a, int b, const Mat3& skew, Eigen::Matrix<double, 12, 12>* H) {
  const auto add = [&](int i, int j) {
    H->block<3, 3>(3 * i, 3 * j) += skew;
    H->block<3, 3>(3 * j, 3 * i) -= skew;
  };
  add(a, b);
  add(b, 0);
  add(0, a);
}

// Eight linear tetrahedra: at the corners, and around the octahedron's diagonal between the
// mid-edge nodes of 01 and 23.
constexpr int kLinearParts[8][4] = {{0, 4, 6, 7}, {4, 1, 5, 8}, {6, 5, 2, 9}, {7, 8, 9, 3},
                                    {4, 9, 6, 7}, {4, 9, 7, 8}, {4, 9, 8, 5}, {4, 9, 5, 6}};

}  // namespace

InversionGuard::InversionGuard(const mesh::TetMesh& mesh, double stiffness)
    : stiffness_(stiffness) {
  if (mesh.midnodes.cols() == 0) {
    tets_ = mesh.tets;
  } else {
    tets_.resize(4, 8 * mesh.tets.cols());
    for (Eigen::Index e = 0; e < mesh.tets.cols(); ++e) {
      for (int part = 0; part < 8; ++part) {
        for (int k = 0; k < 4; ++k) {
          const int node = kLinearParts[part][k];
          tets_(k, 8 * e + part) = node < 4 ? mesh.tets(node, e) : mesh.midnodes(node - 4, e);
        }
      }
    }
  }
  volumes_.resize(tets_.cols());
  for (Eigen::Index e = 0; e < tets_.cols(); ++e) {
    volumes_[e] = edges(mesh.points, e).determinant();
    if (volumes_[e] >= 0.0) continue;
    std::swap(tets_(2, e), tets_(3, e));
    volumes_[e] = -volumes_[e];
  }
}

Mat3 InversionGuard::edges(const Points& x, Eigen::Index e) const {
  Mat3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = x.col(tets_(k + 1, e)) - x.col(tets_(0, e));
  return edges;
}

void InversionGuard::keepOnly(const std::vector<int>& tets) {
  tets_ = tets_(Eigen::all, tets).eval();
  volumes_ = volumes_(tets).eval();
}

double InversionGuard::least(const Points& x) const {
  double least = 1.0;
  for (Eigen::Index e = 0; e < tets_.cols(); ++e) {
    if (volumes_[e] > 0.0) least = std::min(least, edges(x, e).determinant() / volumes_[e]);
  }
  return least;
}

template <class Visit>
void InversionGuard::forFlat(const Points& x, const Visit& visit) const {
  if (!active_) return;
  for (Eigen::Index e = 0; e < tets_.cols(); ++e) {
    const Mat3 at = edges(x, e);
    const double determinant = at.determinant();
    if (determinant < kFrom * volumes_[e]) visit(e, at, determinant / volumes_[e]);
  }
}

// The volume is the determinant over 6.
double InversionGuard::value(const Points& x) const {
  double sum = 0.0;
  forFlat(x, [&](Eigen::Index e, const Mat3&, double J) {
    sum += stiffness_ * volumes_[e] / 6.0 * barrier(J).value;
  });
  return sum;
}

double InversionGuard::addGradient(const Points& x, Points* g) const {
  double sum = 0.0;
  forFlat(x, [&](Eigen::Index e, const Mat3& at, double J) {
    const Barrier b = barrier(J);
    sum += stiffness_ * volumes_[e] / 6.0 * b.value;
    const Eigen::Matrix<double, 3, 4> f = stiffness_ / 6.0 * b.slope * byCorners(cofactors(at));
    for (int k = 0; k < 4; ++k) g->col(tets_(k, e)) += f.col(k);
  });
  return sum;
}

void InversionGuard::addHessian(const Points& x, Tangent tangent, Stiffness* K) const {
  forFlat(x, [&](Eigen::Index e, const Mat3& at, double J) {
    const Barrier b = barrier(J);
    const Mat3 by_edges = cofactors(at);
    const Eigen::Matrix<double, 12, 1> g = byCorners(by_edges).reshaped();
    Eigen::Matrix<double, 12, 12> H =
        stiffness_ / 6.0 * b.curvature / volumes_[e] * g * g.transpose();
    if (tangent == Tangent::kExact) {
      const double scale = stiffness_ / 6.0 * b.slope;
      addPair(1, 2, -scale * cross(at.col(2)), &H);
      addPair(1, 3, scale * cross(at.col(1)), &H);
      addPair(2, 3, -scale * cross(at.col(0)), &H);
    }
    K->add(tets_.col(e), H);
  });
}

}  // namespace palpate::fem
