// SPDX-License-Identifier: GPL-3.0-or-later
// Deformation and stress at single points.
#include <Eigen/Dense>
#include <algorithm>
#include <limits>

#include "jacobian_within.h"
#include "solid_elasticity.h"

namespace palpate::fem {

template <int N>
double SolidElasticity<N>::minJacobian(const Points& x) {
  if (packed_) return packed_->minJacobian(x);
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < shape_.points.size(); ++e) {
    for (const RestPoint<N>& point : shape_.points[e]) {
      smallest = std::min(smallest, deformation(x, e, point.gradients).determinant());
    }
  }
  return smallest;
}

template <int N>
double SolidElasticity<N>::minJacobianWithin(const Points& x) {
  double smallest = minJacobian(x);
  if constexpr (N == 10) {
    for (std::size_t e = 0; e < shape_.points.size(); ++e) {
      Mat3 F[kPoints];
      for (int q = 0; q < kPoints; ++q) F[q] = deformation(x, e, shape_.points[e][q].gradients);
      smallest = std::min(smallest, jacobianWithin(F));
    }
  }
  return smallest;
}

template <int N>
std::vector<PointState> SolidElasticity<N>::states(const Points& x,
                                                   const std::vector<mesh::Location>& places) {
  updatePressure(x);
  std::vector<PointState> states;
  states.reserve(places.size());
  for (const mesh::Location& at : places) states.push_back(state(x, at.tet, at.w));
  return states;
}

template <int N>
PointState SolidElasticity<N>::state(const Points& x, int e, const Eigen::Vector4d& w) const {
  Eigen::Matrix<double, 3, N> X;
  for (int a = 0; a < N; ++a) X.col(a) = mesh_.points.col(shape_.nodes(a, e));
  double determinant = 0.0;
  Eigen::Matrix<double, 3, N> gradients = RestShape<N>::gradientsAt(X, w, &determinant);
  Mat3 Q = Mat3::Identity();
  if (!composition_.frames.empty()) Q = composition_.frames[e];
  gradients = Q.transpose() * gradients;
  const Mat3 F = deformation(x, static_cast<std::size_t>(e), gradients);
  int nearest = 0;  // integration point with the viscous memory to use
  for (int q = 1; q < kPoints; ++q) {
    const auto distance = [&](int k) { return (Tetrahedron<N>::point(k) - w).squaredNorm(); };
    if (distance(q) < distance(nearest)) nearest = q;
  }
  const int solid = composition_.solid_of.empty() ? 0 : composition_.solid_of[e];
  const material::Material& law = composition_.solids[solid].law;
  const double p = pressure_ ? pressure_->at(static_cast<std::size_t>(e), w) : 0.0;
  const bool remembers = history_->isViscous(solid);
  const Mat3 H = remembers ? history_->stress(e, nearest) : Mat3::Zero();
  double psi = 0.0;
  Mat3 P;
  stresses(law,
           {1, &F, history_->factor(solid), element_kappa_[solid], &p, remembers ? &H : nullptr},
           &psi, &P);
  return {F * Q.transpose(), P * F.transpose() / F.determinant()};
}

template double SolidElasticity<4>::minJacobian(const Points&);
template double SolidElasticity<10>::minJacobian(const Points&);
template double SolidElasticity<4>::minJacobianWithin(const Points&);
template double SolidElasticity<10>::minJacobianWithin(const Points&);
template std::vector<PointState> SolidElasticity<4>::states(const Points&,
                                                            const std::vector<mesh::Location>&);
template std::vector<PointState> SolidElasticity<10>::states(const Points&,
                                                             const std::vector<mesh::Location>&);

}  // namespace palpate::fem
