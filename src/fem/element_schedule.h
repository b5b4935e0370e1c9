// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/fem/composition.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::fem {

/// Elements of one solid that follow one another.
struct ElementRun {
  int solid;
  std::vector<int> elements;
};

/// An order in which threads may add up what elements share, with results that do not depend on
/// how many threads there are: phases follow one another; the parts of one phase touch no common
/// node, and each part is worked through in its order.
struct ElementSchedule {
  using Part = std::vector<ElementRun>;
  std::vector<std::vector<Part>> phases;

  /// One part after another.
  std::vector<ElementRun> runs() const;
};

/// The nodes are cut into `kScheduleParts` slabs along the mesh's longest side. First come the
/// elements inside of one slab, then those inside of a pair, then the rest.
ElementSchedule scheduleElements(const mesh::TetMesh& mesh, const Composition& composition);

constexpr int kScheduleParts = 4;

}  // namespace palpate::fem
