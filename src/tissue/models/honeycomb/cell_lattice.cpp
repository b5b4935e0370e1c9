// SPDX-License-Identifier: GPL-3.0-or-later
#include "cell_lattice.h"

namespace palpate::tissue {
namespace {

// Corners of a side, as bits of the cell's corner index for the two axes other than the side's own.
constexpr int kRound[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

std::array<int, 4> cornersOf(const CellLattice::Cell& cell, int axis, int positive) {
  std::array<int, 4> corners{};
  const int b = (axis + 1) % 3, c = (axis + 2) % 3;
  for (std::size_t k = 0; k < 4; ++k) {
    const int corner = positive << axis | kRound[k][0] << b | kRound[k][1] << c;
    corners[k] = cell.corners[static_cast<std::size_t>(corner)];
  }
  return corners;
}

// Numbers things on a grid in the order in which they are asked for, or in that of the grid.
class GridNumbers {
 public:
  explicit GridNumbers(const Eigen::Vector3i& count)
      : count_(count), numbers_(static_cast<std::size_t>(count.prod()), -1) {}
  int& operator[](const Eigen::Vector3i& at) {
    return numbers_[static_cast<std::size_t>(at.x() + count_.x() * (at.y() + count_.y() * at.z()))];
  }
  std::vector<int>& all() { return numbers_; }

 private:
  Eigen::Vector3i count_;
  std::vector<int> numbers_;
};

template <class Visit>
void forGrid(const Eigen::Vector3i& count, const Visit& visit) {
  for (int k = 0; k < count.z(); ++k) {
    for (int j = 0; j < count.y(); ++j) {
      for (int i = 0; i < count.x(); ++i) visit(Eigen::Vector3i(i, j, k));
    }
  }
}

Eigen::Vector3i cornerAt(const Eigen::Vector3i& cell, int corner) {
  return cell + Eigen::Vector3i(corner & 1, corner >> 1 & 1, corner >> 2);
}

void addCorners(const Vec3& low, const Eigen::Vector3i& count, CellLattice* lattice) {
  GridNumbers numbers(count.array() + 1);
  for (const CellLattice::Cell& cell : lattice->cells) {
    for (int c = 0; c < 8; ++c) numbers[cornerAt(cell.at, c)] = 0;
  }
  int used = 0;
  for (int& number : numbers.all()) number = number < 0 ? -1 : used++;
  lattice->corners.resize(3, used);
  for (CellLattice::Cell& cell : lattice->cells) {
    for (int c = 0; c < 8; ++c) {
      const Eigen::Vector3i at = cornerAt(cell.at, c);
      cell.corners[static_cast<std::size_t>(c)] = numbers[at];
      lattice->corners.col(numbers[at]) = low + lattice->size.cwiseProduct(at.cast<double>());
    }
  }
}

void addSides(const Eigen::Vector3i& count, CellLattice* lattice) {
  std::vector<GridNumbers> numbers(3, GridNumbers(count.array() + 1));
  for (int c = 0; c < lattice->numCells(); ++c) {
    CellLattice::Cell& cell = lattice->cells[static_cast<std::size_t>(c)];
    for (int k = 0; k < 6; ++k) {
      const int axis = k / 2, positive = k % 2;
      int& number =
          numbers[static_cast<std::size_t>(axis)][cell.at + positive * Eigen::Vector3i::Unit(axis)];
      if (number < 0) {
        number = lattice->numSides();
        lattice->sides.push_back({axis, {-1, -1}, cornersOf(cell, axis, positive)});
      }
      cell.sides[static_cast<std::size_t>(k)] = number;
      lattice->sides[static_cast<std::size_t>(number)]
          .cells[static_cast<std::size_t>(1 - positive)] = c;
    }
  }
}

void addTriangles(CellLattice* lattice) {
  std::vector<Eigen::Vector3i> triangles;
  for (const CellLattice::Side& side : lattice->sides) {
    if (side.cells[0] >= 0 && side.cells[1] >= 0) continue;
    const auto& c = side.corners;
    if (side.cells[0] >= 0) {
      triangles.emplace_back(c[0], c[1], c[2]);
      triangles.emplace_back(c[0], c[2], c[3]);
    } else {
      triangles.emplace_back(c[0], c[2], c[1]);
      triangles.emplace_back(c[0], c[3], c[2]);
    }
  }
  lattice->triangles.resize(3, static_cast<Eigen::Index>(triangles.size()));
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    lattice->triangles.col(static_cast<Eigen::Index>(t)) = triangles[t];
  }
}

}  // namespace

Vec3 CellLattice::centre(int cell) const {
  const Cell& c = cells[static_cast<std::size_t>(cell)];
  return 0.5 * (corners.col(c.corners[0]) + corners.col(c.corners[7]));
}

Eigen::MatrixXi CellLattice::hexahedra() const {
  constexpr std::size_t kVtk[8] = {0, 1, 3, 2, 4, 5, 7, 6};
  Eigen::MatrixXi all(8, numCells());
  for (int c = 0; c < numCells(); ++c) {
    for (int k = 0; k < 8; ++k) all(k, c) = cells[static_cast<std::size_t>(c)].corners[kVtk[k]];
  }
  return all;
}

CellLattice makeCellLattice(const Vec3& low, const Vec3& size, const Eigen::Vector3i& count,
                            const std::vector<bool>& inside) {
  CellLattice lattice;
  lattice.size = size;
  std::size_t number = 0;
  forGrid(count, [&](const Eigen::Vector3i& at) {
    if (inside[number++]) lattice.cells.push_back({at, {}, {}});
  });
  addCorners(low, count, &lattice);
  addSides(count, &lattice);
  addTriangles(&lattice);
  return lattice;
}

}  // namespace palpate::tissue
