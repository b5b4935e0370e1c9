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

}  // namespace palpate::torture
