// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/skin/two_layer_block.h"

#include <cmath>
#include <string>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/number.h"

namespace palpate::skin {
namespace {

constexpr double kMaxNodes = 2e6;
constexpr double kOnNode = 1e-9;  // over a square's side

[[noreturn]] void refuse(const std::string& key, double value, const std::string& allowed) {
  throw InputError("two-layer block", key, formatNumber(value), allowed);
}

void requirePositive(const std::string& key, double value) {
  if (!(std::isfinite(value) && value > 0.0)) refuse(key, value, "must be a number > 0");
}

// Rings use half of the columns.
struct Grid {
  explicit Grid(const TwoLayerBlock& block)
      : rings(block.idealization == Idealization::kAxisymmetric),
        columns(rings ? block.columns / 2 : block.columns),
        rows(block.rows),
        by_rows(block.numbering == Numbering::kRows) {}

  int node(int column, int row) const {
    return by_rows ? row * (columns + 1) + column : column * (rows + 1) + row;
  }
  int middle() const { return rings ? 0 : columns / 2; }

  bool rings;
  int columns, rows;
  bool by_rows;
};

int patchColumns(const TwoLayerBlock& block) {
  return static_cast<int>(std::lround(block.patch / (block.width / block.columns)));
}

}  // namespace

int upperRows(double fraction, int rows) {
  const double exact = fraction * rows;
  const double nearest = std::round(exact);
  if (!(std::abs(exact - nearest) < 1e-3)) {
    refuse("fraction", fraction,
           "puts the interface inside an element; must be a multiple of 1/" + std::to_string(rows));
  }
  if (!(nearest >= 1.0 && nearest <= rows - 1.0)) {
    refuse("fraction", fraction, "must leave a row of elements to either layer");
  }
  return static_cast<int>(nearest);
}

void checkBlock(const TwoLayerBlock& block) {
  requirePositive("width", block.width);
  requirePositive("height", block.height);
  requirePositive("young_modulus", block.young_modulus);
  requirePositive("stiffness_ratio", block.stiffness_ratio);
  requirePositive("slab", block.slab);
  if (block.columns < 2 || block.columns % 2 != 0) {
    refuse("columns", block.columns, "must be even and >= 2: a node is in the middle");
  }
  if (block.rows < 2) refuse("rows", block.rows, "must be >= 2: one for each layer");
  if ((block.columns + 1.0) * (block.rows + 1.0) > kMaxNodes) {
    refuse("columns", block.columns, "must not make more than 2 million nodes");
  }
  if (block.upper_rows < 1 || block.upper_rows > block.rows - 1) {
    refuse("upper_rows", block.upper_rows, "must be in [1, rows - 1]");
  }
  if (!(block.poisson_ratio > -1.0 && block.poisson_ratio < 0.5)) {
    refuse("poisson_ratio", block.poisson_ratio, "must be in (-1, 0.5)");
  }
  const double side = block.width / block.columns;
  if (!(block.patch >= 0.0 && block.patch < 0.5 * block.width - 0.5 * side)) {
    refuse("patch", block.patch, "must be >= 0 and leave an element to the held sides");
  }
  if (std::abs(block.patch / side - patchColumns(block)) > kOnNode * block.columns) {
    refuse("patch", block.patch, "must end at a node: a multiple of " + formatNumber(side));
  }
}

PlaneMesh blockMesh(const TwoLayerBlock& block) {
  checkBlock(block);
  const Grid grid(block);
  PlaneMesh mesh;
  mesh.points.resize(2, (grid.columns + 1) * (grid.rows + 1));
  for (int i = 0; i <= grid.columns; ++i) {
    for (int j = 0; j <= grid.rows; ++j) {
      mesh.points.col(grid.node(i, j)) << block.width * i / block.columns,
          block.height * j / block.rows;
    }
  }
  for (int i = 0; i < grid.columns; ++i) {
    for (int j = 0; j < grid.rows; ++j) {
      const int here = grid.node(i, j), right = grid.node(i + 1, j), below = grid.node(i, j + 1),
                across = grid.node(i + 1, j + 1);
      if (block.diagonals == Diagonals::kAlternating && (i + j) % 2 != 0) {
        mesh.triangles.push_back({here, right, across});
        mesh.triangles.push_back({here, across, below});
      } else {
        mesh.triangles.push_back({here, right, below});
        mesh.triangles.push_back({across, below, right});
      }
      mesh.materials.insert(mesh.materials.end(), 2, j < block.upper_rows ? 0 : 1);
    }
  }
  return mesh;
}

UnitIndentation indent(const TwoLayerBlock& block) {
  UnitIndentation unit{block, blockMesh(block), {}, 0.0, {}, 0};
  const Grid grid(block);
  const Eigen::Index n = unit.mesh.points.cols();
  PlanePoints held = PlanePoints::Zero(2, n), prescribed = PlanePoints::Zero(2, n);
  for (int i = 0; i <= grid.columns; ++i) held.col(grid.node(i, grid.rows)).setOnes();
  for (int j = 0; j <= grid.rows; ++j) {
    held.col(grid.node(grid.columns, j)).setOnes();
    if (grid.rings) {
      held(0, grid.node(0, j)) = 1.0;  // on the axis
    } else {
      held.col(grid.node(0, j)).setOnes();
    }
  }
  const int reach = patchColumns(block);
  std::vector<int> pressed;
  for (int i = grid.rings ? 0 : grid.middle() - reach; i <= grid.middle() + reach; ++i) {
    const int node = grid.node(i, 0);
    pressed.push_back(node);
    held(1, node) = prescribed(1, node) = 1.0;
    if (!block.slides) held(0, node) = 1.0;
  }
  const double E = block.young_modulus, nu = block.poisson_ratio;
  const Eigen::SparseMatrix<double> K =
      stiffness(unit.mesh,
                {elasticityMatrix(block.idealization, E, nu),
                 elasticityMatrix(block.idealization, E / block.stiffness_ratio, nu)},
                block.idealization, block.slab);
  unit.displacement = displacements(K, PlanePoints::Zero(2, n), held, prescribed);
  const Eigen::VectorXd forces =
      K * Eigen::Map<const Eigen::VectorXd>(unit.displacement.data(), 2 * n);
  for (const int node : pressed) unit.force += forces[2 * node + 1];
  if (grid.rings) {
    for (int i = grid.columns; i >= 0; --i) unit.surface.push_back(grid.node(i, 0));
  } else {
    for (int i = 0; i <= grid.columns; ++i) unit.surface.push_back(grid.node(i, 0));
  }
  unit.band_width = bandWidth(unit.mesh);
  return unit;
}

}  // namespace palpate::skin
