// SPDX-License-Identifier: GPL-3.0-or-later
#include "cell_elasticity.h"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace palpate::tissue {
namespace {

Mat3 edgesOf(const Points& x, const Eigen::Matrix4Xi& tets, Eigen::Index t) {
  Mat3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = x.col(tets(k + 1, t)) - x.col(tets(0, t));
  return edges;
}

}  // namespace

CellElasticity::CellElasticity(const mesh::TetMesh& mesh, const fem::Composition& composition)
    : mesh_(mesh), composition_(composition) {
  if (mesh.quadratic())
    throw std::invalid_argument("needs 4-node tetrahedra; the mesh has 10-node ones");
  volumes_.resize(mesh.numTets());
  masses_.setZero(mesh.numPoints());
  inverse_edges_.reserve(static_cast<std::size_t>(mesh.numTets()));
  for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
    const Mat3 edges = edgesOf(mesh.points, mesh.tets, t);
    volumes_[t] = edges.determinant() / 6.0;
    if (!(volumes_[t] > 0.0)) {
      throw std::invalid_argument("tetrahedron " + std::to_string(t + 1) +
                                  " is inverted or has no volume");
    }
    inverse_edges_.push_back(edges.inverse());
    const double quarter = 0.25 * composition.solid(static_cast<int>(t)).density * volumes_[t];
    for (int k = 0; k < 4; ++k) masses_[mesh.tets(k, t)] += quarter;
  }
}

fem::Stiffness CellElasticity::makeMatrix() const {
  std::vector<std::pair<int, int>> pairs;
  for (Eigen::Index t = 0; t < mesh_.numTets(); ++t) {
    for (int a = 0; a < 4; ++a) {
      for (int b = a + 1; b < 4; ++b) pairs.emplace_back(mesh_.tets(a, t), mesh_.tets(b, t));
    }
  }
  return fem::Stiffness(fem::BlockMatrix(numNodes(), pairs));
}

Mat3 CellElasticity::deformation(const Points& x, Eigen::Index t) const {
  return edgesOf(x, mesh_.tets, t) * inverse_edges_[static_cast<std::size_t>(t)];
}

double CellElasticity::minJacobian(const Points& x) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index t = 0; t < mesh_.numTets(); ++t) {
    least = std::min(least, edgesOf(x, mesh_.tets, t).determinant() / (6.0 * volumes_[t]));
  }
  return least;
}

std::vector<fem::PointState> CellElasticity::states(const Points& x,
                                                    const std::vector<mesh::Location>& places) {
  std::vector<fem::PointState> states;
  states.reserve(places.size());
  for (const mesh::Location& at : places) {
    const Mat3 F = deformation(x, at.tet);
    states.push_back({F, cauchyStress(x, at.tet, F)});
  }
  return states;
}

Eigen::VectorXd CellElasticity::energyBySolid(const Points& x) {
  Eigen::VectorXd sums =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(composition_.solids.size()));
  for (int t = 0; t < static_cast<int>(mesh_.numTets()); ++t) {
    const int solid =
        composition_.solid_of.empty() ? 0 : composition_.solid_of[static_cast<std::size_t>(t)];
    sums[solid] += energyOf(x, t);
  }
  return sums;
}

mesh::LumpedMasses CellElasticity::lumpedMasses() const {
  mesh::LumpedMasses masses{masses_, Eigen::MatrixXd(4, mesh_.numTets())};
  for (Eigen::Index t = 0; t < mesh_.numTets(); ++t) {
    masses.shares.col(t).setConstant(0.25 * composition_.solid(static_cast<int>(t)).density *
                                     volumes_[t]);
  }
  return masses;
}

}  // namespace palpate::tissue
