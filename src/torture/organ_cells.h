// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/sim/simulator.h"

namespace palpate::torture {

/// The cells of all organs of a simulator, made anew only where a mesh becomes another.
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

/// Whether the cells are tetrahedra with corners alone, which a det F each describes.
bool areLinearTets(const mesh::CellMesh& cells);

/// Of each tetrahedron the volume now by that at rest, the smallest.
double leastVolumeRatio(const mesh::CellMesh& rest, const Points& now);

/// Whether they have a node in the middle of each edge.
bool areQuadraticTets(const mesh::CellMesh& cells);

/// Of these det F at the corners, the smallest: of a cubic in position, which may be least there
/// [Johnen, Remacle, Geuzaine 2013].
double leastAtCorners(const mesh::CellMesh& rest, const Points& now);

/// Likewise at the four points of the quadrature that is exact for quadratic polynomials
/// [Hammer, Marlowe, Stroud 1956].
double leastAtQuadraturePoints(const mesh::CellMesh& rest, const Points& now);

}  // namespace palpate::torture
