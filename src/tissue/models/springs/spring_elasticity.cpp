// SPDX-License-Identifier: GPL-3.0-or-later
#include "spring_elasticity.h"

#include <algorithm>
#include <map>
#include <utility>

namespace palpate::tissue {
namespace {

constexpr int kEdges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

}  // namespace

SpringElasticity::SpringElasticity(const mesh::TetMesh& mesh, const fem::Composition& composition,
                                   const springs::SpringNetwork& network)
    : CellElasticity(mesh, composition), forces_(network, mesh.numPoints()) {
  std::map<std::pair<int, int>, int> at;  // the first spring between two points
  for (int s = 0; s < springs().size(); ++s)
    at.emplace(std::minmax(springs().a(s), springs().b(s)), s);
  shared_.assign(static_cast<std::size_t>(springs().size()), 0.0);
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
    const Vec3 way = x.col(springs().b(s)) - x.col(springs().a(s));
    const double u = way.norm();
    if (u > 0.0) virial += share * springs().force(s, u) / u * way * way.transpose();
  });
  return virial / (F.determinant() * volumes()[t]);
}

double SpringElasticity::energyOf(const Points& x, int t) {
  double sum = 0.0;
  forEdges(t, [&](int s, double share) {
    const double u = (x.col(springs().b(s)) - x.col(springs().a(s))).norm();
    sum += share * springs().energy(s, u);
  });
  return sum;
}

}  // namespace palpate::tissue
