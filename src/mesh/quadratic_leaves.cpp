// SPDX-License-Identifier: GPL-3.0-or-later
// Additional data of leaves with quadratic tetrahedra.
#include <array>

#include "leaves.h"

namespace palpate::mesh {
namespace {

using CornerWeights = Eigen::Matrix4d;

Eigen::Matrix<int, 10, Eigen::Dynamic> nodesOf(const TetMesh& mesh) {
  Eigen::Matrix<int, 10, Eigen::Dynamic> nodes(10, mesh.numTets());
  nodes << mesh.tets, mesh.midnodes;
  return nodes;
}

// Barycentric coordinates of the vertices of `cell` in `whole`, one column each, both in cell
// order.
CornerWeights weightsIn(const BisectionTree& tree, int whole, int cell) {
  if (cell == whole) return CornerWeights::Identity();
  const int parent = tree.cell(cell).parent;
  const CornerWeights of_parent = weightsIn(tree, whole, parent);
  const std::array<int, 4>&vertex = tree.cell(cell).vertex, &above = tree.cell(parent).vertex;
  CornerWeights weights;
  for (int k = 0; k < 4; ++k) {
    weights.col(k) = 0.5 * (of_parent.col(0) + of_parent.col(1));
    for (int j = 0; j < 4; ++j) {
      if (vertex[k] == above[j]) weights.col(k) = of_parent.col(j);
    }
  }
  return weights;
}

// The same for corners in the order of the tetrahedra.
CornerWeights cornersIn(const BisectionTree& tree, int whole, int cell) {
  const CornerWeights of_cells = weightsIn(tree, whole, cell);
  CornerWeights corners;
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 4; ++k) {
      corners(i, k) =
          of_cells(Leaves::place(tree.cell(whole), i), Leaves::place(tree.cell(cell), k));
    }
  }
  return corners;
}

// Quadratic shape functions at barycentric coordinates.
std::array<double, 10> shapeFunctions(const Eigen::Vector4d& w) {
  std::array<double, 10> values;
  for (int a = 0; a < 4; ++a) values[a] = w[a] * (2.0 * w[a] - 1.0);
  for (int k = 0; k < 6; ++k) {
    values[4 + k] = 4.0 * w[kMiddlesBetween[k][0]] * w[kMiddlesBetween[k][1]];
  }
  return values;
}

// Barycentric coordinates of a node by those of the corners.
Eigen::Vector4d weightsOfNode(const CornerWeights& corners, int node) {
  if (node < 4) return corners.col(node);
  const auto [i, j] = kMiddlesBetween[node - 4];
  return 0.5 * (corners.col(i) + corners.col(j));
}

}  // namespace

void Leaves::addMiddleNodes(BisectionTree* tree) {
  mesh.midnodes.resize(6, mesh.numTets());
  for (std::size_t t = 0; t < cells.size(); ++t) {
    for (int k = 0; k < 6; ++k) {
      const auto [i, j] = kMiddlesBetween[k];
      const BisectionTree::Cell& cell = tree->cell(cells[t]);
      const int middle = tree->middleOf(cell.edge[kEdgeOf[place(cell, i)][place(cell, j)]]);
      number.resize(static_cast<std::size_t>(tree->numVertices()), -1);
      if (number[middle] < 0) {
        number[middle] = static_cast<int>(vertices.size());
        vertices.push_back(middle);
      }
      mesh.midnodes(k, static_cast<Eigen::Index>(t)) = number[middle];
    }
  }
  const Eigen::Index num_corners = mesh.numPoints();
  mesh.points.conservativeResize(3, static_cast<Eigen::Index>(vertices.size()));
  for (Eigen::Index i = num_corners; i < mesh.numPoints(); ++i) {
    mesh.points.col(i) = tree->rest(vertices[static_cast<std::size_t>(i)]);
  }
  surface = trianglesOf(boundaryFaces(mesh));
}

void addQuadraticChange(const BisectionTree& tree, const Leaves& old, const Leaves& next,
                        MeshChange* change) {
  change->old_nodes = nodesOf(old.mesh);
  change->new_nodes = nodesOf(next.mesh);
  std::vector<char> known(next.vertices.size());
  for (std::size_t i = 0; i < known.size(); ++i) known[i] = change->old_point[i] >= 0;
  for (std::size_t t = 0; t < next.cells.size(); ++t) {
    const auto [first, last] = change->tets[t];
    if (last > first + 1) {
      for (int k = first; k < last; ++k) {
        change->corners.push_back(cornersIn(tree, next.cells[t], old.cells[k]));
      }
      continue;
    }
    const CornerWeights corners = cornersIn(tree, old.cells[first], next.cells[t]);
    change->corners.push_back(corners);
    for (int k = 0; k < 10; ++k) {
      const int point = change->new_nodes(k, static_cast<Eigen::Index>(t));
      if (known[point]) continue;
      known[point] = 1;
      MeshChange::Inside at{point, {}, shapeFunctions(weightsOfNode(corners, k))};
      for (int a = 0; a < 10; ++a) at.nodes[a] = change->old_nodes(a, first);
      change->inside.push_back(at);
    }
  }
}

}  // namespace palpate::mesh
