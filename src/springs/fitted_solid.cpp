// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/fitted_solid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "fourth_order.h"
#include "palpate/springs/continuum.h"
#include "palpate/springs/least_squares.h"
#include "palpate/springs/lumped_mass.h"
#include "palpate/springs/step_bound.h"

namespace palpate::springs {
namespace {

std::vector<Spring> edgesOf(const mesh::TetMesh& mesh) {
  std::set<std::pair<int, int>> edges;
  for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
    for (int k = 0; k < 4; ++k) {
      for (int l = k + 1; l < 4; ++l) {
        edges.insert(std::minmax(mesh.tets(k, t), mesh.tets(l, t)));
      }
    }
  }
  std::vector<Spring> springs;
  springs.reserve(edges.size());
  for (const auto& [a, b] : edges) {
    const double length = (mesh.points.col(b) - mesh.points.col(a)).norm();
    springs.push_back({a, b, 0.0, 0.0, 0.0, length, SpringKind::kEdge});
  }
  return springs;
}

/// The corners only: mid-edge nodes of quadratic tetrahedra have no mass here.
mesh::TetMesh linearPart(const mesh::TetMesh& mesh) {
  mesh::TetMesh linear;
  linear.points = mesh.points.leftCols(mesh.tets.maxCoeff() + 1);
  linear.tets = mesh.tets;
  return linear;
}

/// Conditions on sum k U^2 e e e e over 4/5 E V, at each point.
class TensorConditions {
 public:
  TensorConditions(const SpringNetwork& network, const Eigen::VectorXd& volumes, double E)
      : A(15 * volumes.size(), static_cast<Eigen::Index>(network.springs.size())),
        b(15 * volumes.size()),
        scale_(0.8 * E * volumes) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(30 * network.springs.size());
    for (std::size_t i = 0; i < network.springs.size(); ++i) {
      const Spring& s = network.springs[i];
      const Vec3 d = network.points.col(s.b) - network.points.col(s.a);
      const FourthOrder t = d.squaredNorm() * fourthPower(d.normalized());
      for (const int end : {s.a, s.b}) {
        for (int c = 0; c < 15; ++c) {
          entries.emplace_back(15 * end + c, static_cast<int>(i), t[c] / scale_[end]);
        }
      }
    }
    A.setFromTriplets(entries.begin(), entries.end());
    for (Eigen::Index m = 0; m < volumes.size(); ++m) b.segment<15>(15 * m) = isotropicFourth();
  }

  /// Factor on k with which the sum of all k U^2 is that of 12 E V.
  double matchingFactor(const Eigen::VectorXd& k) const {
    const Eigen::VectorXd left = A * k;
    double sum = 0.0;
    for (Eigen::Index m = 0; m < scale_.size(); ++m) {
      sum += scale_[m] * left.segment<15>(15 * m).dot(isotropicFourth());
    }
    return 45.0 * scale_.sum() / sum;
  }

  std::vector<ConstraintFamily> residuals(const Eigen::VectorXd& k) const {
    const Eigen::VectorXd error = A * k - b;
    const double size = isotropicFourth().norm();
    const auto points = static_cast<double>(scale_.size());
    std::vector<ConstraintFamily> families;
    for (const char* name : {"stretch", "direction", "isotropy"}) {
      families.push_back({name, size * scale_.mean(), 0.0, 0.0});
    }
    for (Eigen::Index m = 0; m < scale_.size(); ++m) {
      const FourthOrderParts parts = partsOf(error.segment<15>(15 * m));
      const double norms[] = {parts.isotropic.norm(), parts.second.norm(), parts.rest.norm()};
      for (std::size_t f = 0; f < families.size(); ++f) {
        const double relative = norms[f] / size;
        families[f].rms += relative * relative / points;
        families[f].worst = std::max(families[f].worst, relative);
      }
    }
    for (ConstraintFamily& family : families) family.rms = std::sqrt(family.rms);
    return families;
  }

  SparseMatrix A;
  Eigen::VectorXd b;

 private:
  Eigen::VectorXd scale_;
};

}  // namespace

SolidFit fitSolid(const mesh::TetMesh& given, double young_modulus, double density,
                  const FitSettings& settings) {
  requirePositive("young_modulus", young_modulus);
  requirePositive("density", density);
  if (given.numTets() == 0) throw std::invalid_argument("there are no tetrahedra");
  const mesh::TetMesh mesh = given.quadratic() ? linearPart(given) : given;
  const Eigen::VectorXd volumes = tetShares(mesh.points, mesh.tets);
  for (Eigen::Index i = 0; i < volumes.size(); ++i) {
    if (volumes[i] == 0.0) {
      throw std::invalid_argument("point " + std::to_string(i) + ": is in no tetrahedron");
    }
  }
  SolidFit fit{{mesh.points, edgesOf(mesh), density * volumes}, {}, 0, 0};
  SpringNetwork& network = fit.network;
  const auto count = static_cast<Eigen::Index>(network.springs.size());
  Eigen::VectorXd upper = Eigen::VectorXd::Constant(count, std::numeric_limits<double>::infinity());
  if (settings.explicit_step != 0.0) {
    upper = largestStiffness(network.springs, network.masses, settings.explicit_step);
  }
  const TensorConditions conditions(network, volumes, young_modulus);
  Eigen::VectorXd k = boundedLeastSquares(conditions.A, conditions.b, upper).x;
  if (settings.match_mean) k = (conditions.matchingFactor(k) * k).cwiseMin(upper);
  for (Eigen::Index i = 0; i < count; ++i) {
    network.springs[static_cast<std::size_t>(i)].stiffness = k[i];
    fit.slack += k[i] == 0.0;
    fit.bounded += k[i] == upper[i];
  }
  fit.stiffness = conditions.residuals(k);
  return fit;
}

}  // namespace palpate::springs
