// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/tet_parts.h"

#include <algorithm>
#include <numeric>

namespace palpate::mesh {
namespace {

// Representative of a node's part, with path halving [Tarjan, van Leeuwen 1984].
int findRoot(std::vector<int>* parent, int i) {
  std::vector<int>& p = *parent;
  while (p[i] != i) i = p[i] = p[p[i]];
  return i;
}

// Part of each node; -1: in no tetrahedron.
std::vector<int> partOfNodes(const TetMesh& mesh, int* num_parts) {
  std::vector<int> parent(mesh.numPoints());
  std::iota(parent.begin(), parent.end(), 0);
  for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
    const int root = findRoot(&parent, mesh.tets(0, t));
    for (int a = 1; a < 4; ++a) parent[findRoot(&parent, mesh.tets(a, t))] = root;
    if (!mesh.quadratic()) continue;
    for (int a = 0; a < 6; ++a) parent[findRoot(&parent, mesh.midnodes(a, t))] = root;
  }
  std::vector<int> part_of_root(mesh.numPoints(), -1), part(mesh.numPoints(), -1);
  *num_parts = 0;
  for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
    int& number = part_of_root[findRoot(&parent, mesh.tets(0, t))];
    if (number < 0) number = (*num_parts)++;
  }
  for (std::size_t i = 0; i < part.size(); ++i) {
    part[i] = part_of_root[findRoot(&parent, static_cast<int>(i))];
  }
  return part;
}

// Extracts the mesh of a part with known nodes and tetrahedra; `local` gives the node indices in
// it.
void extract(const TetMesh& whole, const std::vector<int>& local, TetPart* part) {
  const auto n = static_cast<Eigen::Index>(part->nodes.size());
  const auto m = static_cast<Eigen::Index>(part->tets.size());
  const auto number = [&](int i) { return local[i]; };
  TetMesh& mesh = part->mesh;
  mesh.points.resize(3, n);
  for (Eigen::Index i = 0; i < n; ++i) mesh.points.col(i) = whole.points.col(part->nodes[i]);
  mesh.tets.resize(4, m);
  mesh.midnodes.resize(6, whole.quadratic() ? m : 0);
  for (Eigen::Index t = 0; t < m; ++t) {
    mesh.tets.col(t) = whole.tets.col(part->tets[t]).unaryExpr(number);
    if (whole.quadratic()) {
      mesh.midnodes.col(t) = whole.midnodes.col(part->tets[t]).unaryExpr(number);
    }
    if (!whole.region.empty()) mesh.region.push_back(whole.region[part->tets[t]]);
  }
  for (const auto& [name, values] : whole.cell_data) {
    Eigen::MatrixXd own(values.rows(), m);
    for (Eigen::Index t = 0; t < m; ++t) own.col(t) = values.col(part->tets[t]);
    mesh.cell_data[name] = own;
  }
}

}  // namespace

std::vector<TetPart> splitParts(const TetMesh& mesh) {
  int num_parts = 0;
  const std::vector<int> part_of = partOfNodes(mesh, &num_parts);
  std::vector<TetPart> parts(num_parts);
  std::vector<int> local(part_of.size(), -1);
  for (std::size_t i = 0; i < part_of.size(); ++i) {
    if (part_of[i] < 0) continue;
    std::vector<int>& nodes = parts[part_of[i]].nodes;
    local[i] = static_cast<int>(nodes.size());
    nodes.push_back(static_cast<int>(i));
  }
  for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
    parts[part_of[mesh.tets(0, t)]].tets.push_back(static_cast<int>(t));
  }
  for (TetPart& part : parts) extract(mesh, local, &part);
  return parts;
}

}  // namespace palpate::mesh
