// SPDX-License-Identifier: GPL-3.0-or-later
#include "sheet_elasticity.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace palpate::tissue {
namespace {

double areaOf(const Points& x, const Eigen::Matrix3Xi& triangles, Eigen::Index t) {
  const Vec3 a = x.col(triangles(0, t)), b = x.col(triangles(1, t)), c = x.col(triangles(2, t));
  return 0.5 * (b - a).cross(c - a).norm();
}

}  // namespace

SheetElasticity::SheetElasticity(const springs::SpringNetwork& network,
                                 const Eigen::Matrix3Xi& triangles, double thickness)
    : forces_(network, network.points.cols()), triangles_(triangles), areas_(triangles.cols()) {
  masses_ = network.masses;
  for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
    areas_[t] = areaOf(network.points, triangles, t);
    if (!(areas_[t] > 0.0)) {
      throw std::invalid_argument("triangle " + std::to_string(t + 1) + " has no area");
    }
  }
  volume_ = thickness * areas_.sum();
}

double SheetElasticity::minJacobian(const Points& x) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index t = 0; t < triangles_.cols(); ++t) {
    least = std::min(least, areaOf(x, triangles_, t) / areas_[t]);
  }
  return least;
}

std::vector<fem::PointState> SheetElasticity::states(const Points&,
                                                     const std::vector<mesh::Location>&) {
  throw std::invalid_argument("a sheet has no tetrahedra to ask for strains and stresses");
}

Eigen::VectorXd SheetElasticity::energyBySolid(const Points& x) {
  return Eigen::VectorXd::Constant(1, energy(x));
}

mesh::LumpedMasses SheetElasticity::lumpedMasses() const {
  return {masses_, Eigen::MatrixXd(4, 0)};
}

}  // namespace palpate::tissue
