// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/fem/composition.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::fem {

/// Consecutive elements of one solid.
struct ElementRun {
  int solid;
  std::vector<int> elements;
};

/// Order of summation over elements whose result is independent of the number of threads. Phases
/// are sequential. Parts of a phase share no node, and each part is summed in its order.
struct ElementSchedule {
  using Part = std::vector<ElementRun>;
  std::vector<std::vector<Part>> phases;

  /// All runs, part after part.
  std::vector<ElementRun> runs() const;
};

/// Cuts the nodes into `kScheduleParts` slabs along the mesh's longest side. First come the
/// elements within one slab, then those within a pair of slabs, then the rest.
ElementSchedule scheduleElements(const mesh::TetMesh& mesh, const Composition& composition);

constexpr int kScheduleParts = 4;

}  // namespace palpate::fem
