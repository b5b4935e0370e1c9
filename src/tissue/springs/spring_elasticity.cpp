// SPDX-License-Identifier: GPL-3.0-or-later
#include "spring_elasticity.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "palpate/springs/step_bound.h"

namespace palpate::tissue {
namespace {

constexpr int kEdges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

// Of a spring that pulls by `force` at the distance `u`: how it resists motion along and across.
Mat3 tangentOf(const Vec3& way, double u, double stiffness, double force, bool projected) {
  const Vec3 n = way / u;
  double along = stiffness, across = force / u;
  if (projected) across = std::max(across, 0.0);
  return (along - across) * n * n.transpose() + across * Mat3::Identity();
}

const springs::SpringNetwork& checked(const springs::SpringNetwork& network,
                                      const mesh::TetMesh& mesh) {
  springs::checkNetwork(network);
  if (network.points.cols() != mesh.numPoints()) {
    throw std::invalid_argument("springs between " + std::to_string(network.points.cols()) +
                                " points; the mesh has " + std::to_string(mesh.numPoints()));
  }
  return network;
}

}  // namespace

SpringElasticity::SpringElasticity(const mesh::TetMesh& mesh, const fem::Composition& composition,
                                   const springs::SpringNetwork& network)
    : CellElasticity(mesh, composition),
      springs_(checked(network, mesh)),
      largest_square_(std::pow(2.0 / springs::largestStep(network), 2)) {
  std::map<std::pair<int, int>, int> at;  // the first spring between two points
  for (int s = 0; s < springs_.size(); ++s)
    at.emplace(std::minmax(springs_.a(s), springs_.b(s)), s);
  shared_.assign(static_cast<std::size_t>(springs_.size()), 0.0);
  of_tet_.reserve(static_cast<std::size_t>(mesh.numTets()));
  for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
    Eigen::Matrix<int, 6, 1> edges;
    for (int e = 0; e < 6; ++e) {
      const auto ends = std::minmax(mesh.tets(kEdges[e][0], t), mesh.tets(kEdges[e][1], t));
      const auto found = at.find(ends);
      edges[e] = found == at.end() ? -1 : found->second;
      if (edges[e] >= 0) shared_[static_cast<std::size_t>(edges[e])] += volumes()[t];
    }
    of_tet_.push_back(edges);
  }
}

fem::Stiffness SpringElasticity::makeMatrix() const {
  std::vector<std::pair<int, int>> pairs;
  pairs.reserve(static_cast<std::size_t>(springs_.size()));
  for (int s = 0; s < springs_.size(); ++s) pairs.emplace_back(springs_.a(s), springs_.b(s));
  return fem::Stiffness(fem::BlockMatrix(numNodes(), pairs));
}

double SpringElasticity::energy(const Points& x) { return springs_.energy(x); }

double SpringElasticity::gradient(const Points& x, Points* g) {
  g->setZero(3, x.cols());
  return springs_.addGradient(x, g);
}

void SpringElasticity::hessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) {
  K->setZero();
  fem::BlockMatrix& blocks = K->blocks();
  for (int s = 0; s < springs_.size(); ++s) {
    const int a = springs_.a(s), b = springs_.b(s);
    const Vec3 way = x.col(b) - x.col(a);
    const double u = way.norm();
    if (!(u > 0.0)) continue;
    const Mat3 H = tangentOf(way, u, springs_.stiffness(s), springs_.force(s, u),
                             tangent == fem::Tangent::kProjected);
    blocks.block(blocks.diagonal(a)) += H;
    blocks.block(blocks.diagonal(b)) += H;
    const int slot = blocks.find(a, b);
    blocks.block(slot) -= H;
    blocks.block(blocks.transposed(slot)) -= H;
  }
}

template <class Visit>
void SpringElasticity::forEdges(int t, const Visit& visit) const {
  for (const int s : of_tet_[static_cast<std::size_t>(t)]) {
    if (s >= 0) visit(s, volumes()[t] / shared_[static_cast<std::size_t>(s)]);
  }
}

// The virial of the springs' shares [Tsai 1979].
Mat3 SpringElasticity::cauchyStress(const Points& x, int t, const Mat3& F) {
  Mat3 virial = Mat3::Zero();
  forEdges(t, [&](int s, double share) {
    const Vec3 way = x.col(springs_.b(s)) - x.col(springs_.a(s));
    const double u = way.norm();
    if (u > 0.0) virial += share * springs_.force(s, u) / u * way * way.transpose();
  });
  return virial / (F.determinant() * volumes()[t]);
}

double SpringElasticity::energyOf(const Points& x, int t) {
  double sum = 0.0;
  forEdges(t, [&](int s, double share) {
    const double u = (x.col(springs_.b(s)) - x.col(springs_.a(s))).norm();
    sum += share * springs_.energy(s, u);
  });
  return sum;
}

}  // namespace palpate::tissue
