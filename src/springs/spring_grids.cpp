// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/spring_grids.h"

#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "palpate/springs/lumped_mass.h"

namespace palpate::springs {
namespace {

void requireAtLeast(const char* name, int value, int least) {
  if (value >= least) return;
  throw std::invalid_argument(std::string(name) + " = " + std::to_string(value) +
                              "; must be >= " + std::to_string(least));
}

/// Nodes of a sheet by position.
class Grid {
 public:
  explicit Grid(const std::vector<GridNode>& nodes) : nodes_(nodes) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!index_.emplace(key(nodes[i]), static_cast<int>(i)).second) {
        throw std::invalid_argument("node " + std::to_string(i) + ": is listed twice");
      }
    }
  }

  int find(const GridNode& node) const {
    const auto found = index_.find(key(node));
    return found == index_.end() ? -1 : found->second;
  }

  // Connects every node with the one at `step`; `passing`: requires the node between.
  void connect(const GridNode& step, bool passing, const StencilSpring& values, SpringKind kind,
               SpringNetwork* network) const {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const int a = static_cast<int>(i), b = find(nodes_[i] + step);
      if (b < 0 || (passing && find(nodes_[i] + step / 2) < 0)) continue;
      const double length = (network->points.col(b) - network->points.col(a)).norm();
      network->springs.push_back({a, b, values.stiffness, values.preload, 0.0, length, kind});
    }
  }

  // Cells with these corners relative to a node, for nodes where all corners exist.
  template <int Corners>
  Eigen::Matrix<int, Corners, Eigen::Dynamic> cells(
      const std::vector<std::array<GridNode, Corners>>& shapes) const {
    std::vector<Eigen::Matrix<int, Corners, 1>> found;
    for (const GridNode& node : nodes_) {
      for (const auto& shape : shapes) {
        Eigen::Matrix<int, Corners, 1> cell;
        for (int k = 0; k < Corners; ++k) cell[k] = find(node + shape[static_cast<std::size_t>(k)]);
        if (cell.minCoeff() >= 0) found.push_back(cell);
      }
    }
    Eigen::Matrix<int, Corners, Eigen::Dynamic> cells(Corners,
                                                      static_cast<Eigen::Index>(found.size()));
    for (std::size_t i = 0; i < found.size(); ++i) {
      cells.col(static_cast<Eigen::Index>(i)) = found[i];
    }
    return cells;
  }

 private:
  static std::pair<int, int> key(const GridNode& node) { return {node.x(), node.y()}; }

  const std::vector<GridNode>& nodes_;
  std::map<std::pair<int, int>, int> index_;
};

Points sheetPoints(const std::vector<GridNode>& nodes, const Eigen::Matrix2d& axes) {
  Points points = Points::Zero(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    points.col(static_cast<Eigen::Index>(i)).head<2>() = axes * nodes[i].cast<double>();
  }
  return points;
}

}  // namespace

SpringNetwork lineNetwork(const LineSprings& springs, double spacing, int nodes,
                          double line_density) {
  requireAtLeast("nodes", nodes, 2);
  requirePositive("spacing", spacing);
  requirePositive("line_density", line_density);
  std::vector<GridNode> line;
  line.reserve(static_cast<std::size_t>(nodes));
  for (int i = 0; i < nodes; ++i) line.emplace_back(i, 0);
  const Grid grid(line);
  SpringNetwork network;
  network.points = sheetPoints(line, spacing * Eigen::Matrix2d::Identity());
  grid.connect({1, 0}, false, springs.structural, SpringKind::kStructural, &network);
  grid.connect({2, 0}, true, springs.flexion, SpringKind::kFlexion, &network);
  network.masses = Eigen::VectorXd::Constant(nodes, line_density * spacing);
  network.masses[0] = network.masses[nodes - 1] = 0.5 * line_density * spacing;
  return network;
}

SpringNetwork rectangleNetwork(const RectangleSprings& springs, double spacing,
                               const std::vector<GridNode>& nodes, double areal_density) {
  requirePositive("spacing", spacing);
  requirePositive("areal_density", areal_density);
  const Grid grid(nodes);
  SpringNetwork network;
  network.points = sheetPoints(nodes, spacing * Eigen::Matrix2d::Identity());
  for (const GridNode& step : {GridNode(1, 0), GridNode(0, 1)}) {
    grid.connect(step, false, springs.structural, SpringKind::kStructural, &network);
    grid.connect(2 * step, true, springs.flexion, SpringKind::kFlexion, &network);
  }
  for (const GridNode& step : {GridNode(1, 1), GridNode(1, -1)}) {
    grid.connect(step, false, springs.shear, SpringKind::kShear, &network);
  }
  network.masses =
      areal_density *
      rectangleShares(
          network.points,
          grid.cells<4>({{GridNode(0, 0), GridNode(1, 0), GridNode(1, 1), GridNode(0, 1)}}));
  checkNetwork(network);
  return network;
}

SpringNetwork triangleNetwork(const TriangleSprings& springs, double spacing,
                              const std::vector<GridNode>& nodes, double areal_density) {
  requirePositive("spacing", spacing);
  requirePositive("areal_density", areal_density);
  Eigen::Matrix2d axes;
  axes << 1.0, 0.5, 0.0, 0.5 * std::sqrt(3.0);
  const Grid grid(nodes);
  SpringNetwork network;
  network.points = sheetPoints(nodes, spacing * axes);
  for (const GridNode& step : {GridNode(1, 0), GridNode(0, 1), GridNode(-1, 1)}) {
    grid.connect(step, false, springs.structural, SpringKind::kStructural, &network);
    grid.connect(2 * step, true, springs.flexion, SpringKind::kFlexion, &network);
  }
  network.masses =
      areal_density *
      triangleShares(network.points,
                     grid.cells<3>({{GridNode(0, 0), GridNode(1, 0), GridNode(0, 1)},
                                    {GridNode(0, 0), GridNode(0, 1), GridNode(-1, 1)}}));
  checkNetwork(network);
  return network;
}

std::vector<GridNode> rectangleNodes(int columns, int rows) {
  std::vector<GridNode> nodes;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) nodes.emplace_back(i, j);
  }
  return nodes;
}

std::vector<GridNode> triangleNodes(int columns, int rows) {
  std::vector<GridNode> nodes = rectangleNodes(columns, rows);
  for (GridNode& node : nodes) node.x() -= node.y() / 2;
  return nodes;
}

}  // namespace palpate::springs
