// SPDX-License-Identifier: GPL-3.0-or-later
#include "cell_fabric.h"

#include <algorithm>

namespace palpate::tissue {
namespace {

void addTo(std::vector<Coupling>* all, int other, double stiffness) {
  const auto known = std::find_if(all->begin(), all->end(),
                                  [other](const Coupling& c) { return c.other == other; });
  if (known == all->end()) {
    all->push_back({other, stiffness});
  } else {
    known->stiffness += stiffness;
  }
}

double between(const CellFabric& fabric, int side, int other) {
  for (const Coupling& c : fabric.shear[static_cast<std::size_t>(side)]) {
    if (c.other == other) return c.stiffness;
  }
  return 0.0;
}

class Maker {
 public:
  Maker(const CellLattice& lattice, const HeldSides& held, const std::vector<double>& modulus)
      : lattice_(lattice), held_(held), modulus_(modulus) {}

  CellFabric make() {
    const auto cells = static_cast<std::size_t>(lattice_.numCells());
    fabric_.shear.resize(lattice_.sides.size());
    fabric_.turning.resize(3 * cells);
    fabric_.shear_to_held.setZero(lattice_.numSides());
    fabric_.turning_to_held.setZero(3 * lattice_.numCells());
    for (const double G : modulus_) {
      fabric_.stretch.emplace_back(2.0 * G * lattice_.volume() *
                                   lattice_.size.cwiseAbs2().cwiseInverse());
    }
    forNeighbours([this](int c, int side, int other) { addShear(c, side, other); });
    forNeighbours([this](int c, int side, int other) { addTurning(c, side, other); });
    sumUp();
    return std::move(fabric_);
  }

 private:
  // visit(cell, side, cell behind it) once a pair, with -1 where the side is held.
  template <class Visit>
  void forNeighbours(const Visit& visit) const {
    for (int c = 0; c < lattice_.numCells(); ++c) {
      for (int k = 0; k < 6; ++k) {
        const int side = sideOf(c, k), other = lattice_.neighbour(c, k);
        if (held_.all[static_cast<std::size_t>(side)]) visit(c, k, -1);
        if (k % 2 == 1 && other >= 0) visit(c, k, other);
      }
    }
  }
  int sideOf(int cell, int k) const {
    return lattice_.cells[static_cast<std::size_t>(cell)].sides[static_cast<std::size_t>(k)];
  }
  double modulus(int cell) const { return modulus_[static_cast<std::size_t>(cell)]; }

  void addShear(int cell, int k, int other) {
    const int j = k / 2;
    const double half = 0.5 * lattice_.volume() / (lattice_.size[j] * lattice_.size[j]);
    for (int wall = 0; wall < 6; ++wall) {
      if (wall / 2 == j) continue;
      const int a = sideOf(cell, wall);
      if (other < 0) {
        fabric_.shear_to_held[a] += 2.0 * half * modulus(cell);
        continue;
      }
      const int b = sideOf(other, wall);
      const double t = half * 0.5 * (modulus(cell) + modulus(other));
      addTo(&fabric_.shear[static_cast<std::size_t>(a)], b, t);
      addTo(&fabric_.shear[static_cast<std::size_t>(b)], a, t);
    }
  }

  // Of both walls normal to axis m, to the neighbour or to what is held.
  double wallShear(int cell, int other, int m) const {
    double sum = 0.0;
    for (int k = 2 * m; k < 2 * m + 2; ++k) {
      const int side = sideOf(cell, k);
      sum += other < 0 ? fabric_.shear_to_held[side] : between(fabric_, side, sideOf(other, k));
    }
    return sum;
  }

  void addTurning(int cell, int k, int other) {
    const Vec3& l = lattice_.size;
    const int j = k / 2;
    for (int i = 0; i < 3; ++i) {
      double C = 0.0;
      if (i == j) {
        const int m = (i + 1) % 3, n = (i + 2) % 3;
        C = (wallShear(cell, other, m) * l[n] * l[n] + wallShear(cell, other, n) * l[m] * l[m]) /
            6.0;
      } else {
        const int m = 3 - i - j;
        const auto k_of = [&](int c) { return fabric_.stretch[static_cast<std::size_t>(c)][j]; };
        C = (k_of(cell) + k_of(other < 0 ? cell : other)) * l[m] * l[m] / 24.0 +
            0.5 * l[j] * l[j] * wallShear(cell, other, m);
      }
      const int a = 3 * cell + i;
      if (other < 0) {
        fabric_.turning_to_held[a] += C;
      } else {
        addTo(&fabric_.turning[static_cast<std::size_t>(a)], 3 * other + i, C);
        addTo(&fabric_.turning[static_cast<std::size_t>(3 * other + i)], a, C);
      }
    }
  }

  void sumUp() {
    fabric_.diagonal = fabric_.shear_to_held;
    for (int s = 0; s < lattice_.numSides(); ++s) {
      for (const Coupling& c : fabric_.shear[static_cast<std::size_t>(s)]) {
        fabric_.diagonal[s] += c.stiffness;
      }
      const CellLattice::Side& side = lattice_.sides[static_cast<std::size_t>(s)];
      for (const int c : side.cells) {
        if (c >= 0) fabric_.diagonal[s] += fabric_.stretch[static_cast<std::size_t>(c)][side.axis];
      }
    }
    fabric_.turning_diagonal = fabric_.turning_to_held;
    for (std::size_t a = 0; a < fabric_.turning.size(); ++a) {
      for (const Coupling& c : fabric_.turning[a]) {
        fabric_.turning_diagonal[static_cast<Eigen::Index>(a)] += c.stiffness;
      }
    }
  }

  const CellLattice& lattice_;
  const HeldSides& held_;
  const std::vector<double>& modulus_;
  CellFabric fabric_;
};

}  // namespace

HeldSides heldSides(const CellLattice& lattice, const Eigen::Matrix3Xd& free) {
  HeldSides held;
  for (const CellLattice::Side& side : lattice.sides) {
    bool normal = true, all = true;
    for (const int corner : side.corners) {
      normal = normal && free(side.axis, corner) == 0.0;
      all = all && free.col(corner).isZero(0.0);
    }
    held.along_normal.push_back(normal);
    held.all.push_back(all);
  }
  return held;
}

CellFabric makeCellFabric(const CellLattice& lattice, const HeldSides& held,
                          const std::vector<double>& shear_modulus) {
  return Maker(lattice, held, shear_modulus).make();
}

}  // namespace palpate::tissue
