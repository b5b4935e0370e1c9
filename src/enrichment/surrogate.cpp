// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/enrichment/surrogate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpate::enrichment {

double SeenRegion::distance(const Vec6& x) const {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& sample : samples.colwise()) {
    const Vec3 d = sample.tail<3>();
    const double length = d.squaredNorm();
    const double t = length > 0.0 ? std::clamp(x.tail<3>().dot(d) / length, 0.0, 1.0) : 0.0;
    least = std::min(least, (x.head<3>() - sample.head<3>()).squaredNorm() +
                                (x.tail<3>() - t * d).squaredNorm());
  }
  return std::sqrt(least);
}

Eigen::Index Surrogate::numParameters() const {
  if (const auto* kernel = std::get_if<KernelMap>(&map)) return kernel->numParameters();
  return std::get<Perceptron>(map).parameters().size();
}

void Surrogate::predict(const Vec3& place, const Vec3& displacement, Eigen::VectorXd* work,
                        Vec3* force, Eigen::VectorXd* coefficients) {
  const double length = displacement.norm();
  Vec6 x;
  x << place, displacement * (length > longest ? longest / length : 1.0);
  x = (x - middle).cwiseQuotient(scale);
  const Vec3 d = displacement / displacement_scale;
  const Eigen::Index rows = coefficients ? 3 + numModes() : 3;
  std::visit([&](auto& of) { of.evaluate(x, d, rows, work); }, map);
  *work += plain.topRows(rows).lazyProduct(d);
  *force = force_scale * work->head<3>();
  if (coefficients) *coefficients = mode_scale * work->tail(rows - 3);
}

double Surrogate::strangeness(const Vec3& place, const Vec3& displacement) const {
  Vec6 x;
  x << place, displacement;
  return seen.distance(x.cwiseQuotient(seen_scale)) / seen.threshold;
}

void Surrogate::shape(const Eigen::VectorXd& coefficients, Points* displacements) const {
  displacements->setZero(3, modes.rows() / 3);
  Eigen::Map<Eigen::VectorXd> flat(displacements->data(), displacements->size());
  for (Eigen::Index m = 0; m < modes.cols(); ++m) {
    flat += coefficients[m] * modes.col(m).cast<double>();
  }
}

}  // namespace palpate::enrichment
