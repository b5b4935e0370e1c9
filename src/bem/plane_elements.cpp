// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/bem/plane_elements.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace palpate::bem {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double kLeastPivotRatio = 1e-12;  // over the largest pivot

// Gauss-Legendre, ten points, the positive half [Abramowitz, Stegun 1964, table 25.4].
constexpr double kLineRule[5][2] = {{0.148874338981631211, 0.295524224714752870},
                                    {0.433395394129247191, 0.269266719309996355},
                                    {0.679409568299024406, 0.219086362515982044},
                                    {0.865063366688984511, 0.149451349150580593},
                                    {0.973906528517171720, 0.066671344308688138}};

double shearModulus(double young_modulus, double poisson_ratio) {
  if (!(young_modulus > 0.0)) {
    throw std::invalid_argument("young_modulus = " + std::to_string(young_modulus) +
                                "; must be > 0");
  }
  if (!(poisson_ratio > -1.0 && poisson_ratio < 0.5)) {
    throw std::invalid_argument("poisson_ratio = " + std::to_string(poisson_ratio) +
                                "; must be in (-1, 0.5)");
  }
  return young_modulus / (2.0 * (1.0 + poisson_ratio));
}

}  // namespace

PlaneSolid planeStrain(double young_modulus, double poisson_ratio) {
  return {shearModulus(young_modulus, poisson_ratio), poisson_ratio};
}

PlaneSolid planeStress(double young_modulus, double poisson_ratio) {
  return {shearModulus(young_modulus, poisson_ratio), poisson_ratio / (1.0 + poisson_ratio)};
}

PlaneElements::PlaneElements(const Eigen::Matrix2Xd& points, const Eigen::Matrix2Xi& ends,
                             const PlaneSolid& solid)
    : solid_(solid),
      size_((points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm()),
      middles_(2, ends.cols()),
      halves_(2, ends.cols()),
      normals_(2, ends.cols()),
      lengths_(ends.cols()),
      H_(2 * ends.cols(), 2 * ends.cols()),
      G_(2 * ends.cols(), 2 * ends.cols()) {
  for (Eigen::Index k = 0; k < ends.cols(); ++k) {
    if (ends.col(k).minCoeff() < 0 || ends.col(k).maxCoeff() >= points.cols()) {
      throw std::invalid_argument("element " + std::to_string(k) + " ends at no point");
    }
    const Vector2d a = points.col(ends(0, k)), b = points.col(ends(1, k));
    middles_.col(k) = 0.5 * (a + b);
    halves_.col(k) = 0.5 * (b - a);
    lengths_[k] = (b - a).norm();
    if (!(lengths_[k] > 0.0)) {
      throw std::invalid_argument("element " + std::to_string(k) + " has no length");
    }
    normals_.col(k) = Vector2d(b.y() - a.y(), a.x() - b.x()) / lengths_[k];
  }
  for (Eigen::Index i = 0; i < size(); ++i) {
    for (Eigen::Index j = 0; j < size(); ++j) {
      Matrix2d U = ownU(i), T = 0.5 * Matrix2d::Identity();
      if (i != j) integrate(middles_.col(i), j, &U, &T);
      H_.block<2, 2>(2 * i, 2 * j) = T;
      G_.block<2, 2>(2 * i, 2 * j) = U;
    }
  }
}

Matrix2d PlaneElements::ownU(Eigen::Index element) const {
  const Vector2d l = halves_.col(element);
  const double R = l.norm(), nu = solid_.poisson_ratio;
  return R / (4.0 * M_PI * solid_.shear_modulus * (1.0 - nu)) *
         ((3.0 - 4.0 * nu) * (1.0 - std::log(R / size_)) * Matrix2d::Identity() +
          l * l.transpose() / (R * R));
}

void PlaneElements::integrate(const Vector2d& p, Eigen::Index element, Matrix2d* U,
                              Matrix2d* T) const {
  const double nu = solid_.poisson_ratio;
  const Vector2d n = normals_.col(element);
  U->setZero();
  T->setZero();
  for (const auto& gauss : kLineRule) {
    for (const double side : {-1.0, 1.0}) {
      const Vector2d way = middles_.col(element) + side * gauss[0] * halves_.col(element) - p;
      const double r = way.norm(), weight = 0.5 * gauss[1] * lengths_[element];
      const Vector2d e = way / r;
      *U += weight *
            ((3.0 - 4.0 * nu) * std::log(size_ / r) * Matrix2d::Identity() + e * e.transpose());
      *T += weight / r *
            (e.dot(n) * ((1.0 - 2.0 * nu) * Matrix2d::Identity() + 2.0 * e * e.transpose()) -
             (1.0 - 2.0 * nu) * (e * n.transpose() - n * e.transpose()));
    }
  }
  *U /= 8.0 * M_PI * solid_.shear_modulus * (1.0 - nu);
  *T /= -4.0 * M_PI * (1.0 - nu);
}

PlaneSolution PlaneElements::solve(const PlaneConditions& conditions) const {
  if (conditions.held.cols() != size() || conditions.value.cols() != size()) {
    throw std::invalid_argument("conditions are of " + std::to_string(conditions.held.cols()) +
                                " elements, and there are " + std::to_string(size()));
  }
  // Scales unknown tractions by the shear modulus and displacements by D, so that pivots are
  // comparable.
  const double unit = solid_.shear_modulus / size_;
  Eigen::MatrixXd A(2 * size(), 2 * size());
  Eigen::VectorXd b = Eigen::VectorXd::Zero(2 * size());
  for (Eigen::Index k = 0; k < 2 * size(); ++k) {
    const double value = conditions.value.data()[k];
    if (conditions.held.data()[k]) {
      A.col(k) = -unit * G_.col(k);
      b -= value * H_.col(k);
    } else {
      A.col(k) = H_.col(k);
      b += value * G_.col(k);
    }
  }
  const Eigen::PartialPivLU<Eigen::MatrixXd> factor(A);
  const auto pivots = factor.matrixLU().diagonal().cwiseAbs();
  if (!(pivots.minCoeff() > kLeastPivotRatio * pivots.maxCoeff()) || !conditions.held.any()) {
    throw std::invalid_argument("the conditions leave the body a motion; hold more of it");
  }
  const Eigen::VectorXd x = factor.solve(b);
  PlaneSolution solution{conditions.value, conditions.value};
  for (Eigen::Index k = 0; k < 2 * size(); ++k) {
    if (conditions.held.data()[k]) {
      solution.traction.data()[k] = unit * x[k];
    } else {
      solution.displacement.data()[k] = x[k];
    }
  }
  return solution;
}

Vector2d PlaneElements::displacement(const Vector2d& inside, const PlaneSolution& solution) const {
  Vector2d u = Vector2d::Zero();
  Matrix2d U, T;
  for (Eigen::Index k = 0; k < size(); ++k) {
    integrate(inside, k, &U, &T);
    u += U * solution.traction.col(k) - T * solution.displacement.col(k);
  }
  return u;
}

}  // namespace palpate::bem
