// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/sim/simulator.h"

namespace palpate::torture {

/// Cells of all organs of a simulator, updated when a mesh changes.
class OrganCells {
 public:
  const mesh::CellMesh& of(const sim::Simulator& simulator, int organ);

 private:
  struct Kept {
    mesh::CellMesh cells;
    std::uint64_t revision = 0;
    bool made = false;
  };
  std::vector<Kept> kept_;
};

/// Whether the cells are linear tetrahedra, each with a constant det F.
bool areLinearTets(const mesh::CellMesh& cells);

/// Least ratio of present to rest volume of all tetrahedra.
double leastVolumeRatio(const mesh::CellMesh& rest, const Points& now);

/// Whether the cells are quadratic tetrahedra.
bool areQuadraticTets(const mesh::CellMesh& cells);

/// Least det F at the corners of quadratic tetrahedra, where this cubic may have its minimum
/// [Johnen, Remacle, Geuzaine 2013].
double leastAtCorners(const mesh::CellMesh& rest, const Points& now);

/// Least det F at the four points of the quadrature of degree 2 [Hammer, Marlowe, Stroud 1956].
double leastAtQuadraturePoints(const mesh::CellMesh& rest, const Points& now);

}  // namespace palpate::torture
