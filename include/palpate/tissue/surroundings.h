// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "palpate/fem/cavity.h"
#include "palpate/fem/foundation.h"
#include "palpate/fem/supports.h"
#include "palpate/tissue/motion.h"

namespace palpate::tissue {

/// Nodes with prescribed motion in all components.
struct CarriedNodes {
  std::vector<int> nodes;  ///< Ascending.
  Motion motion;
};

/// Springs on the boundary faces with all corners in `nodes`, anchored at rest positions or moved.
struct SpringSupport {
  std::vector<int> nodes;  ///< Ascending.
  fem::FoundationConstants constants;
  std::optional<Motion> motion;
};

/// Pressure on the boundary faces with all corners in `nodes`.
struct PressedFaces {
  std::vector<int> nodes;  ///< Ascending.
  fem::CavityContent content;
};

/// Boundary conditions of an organ other than gravity and tools, on the nodes of a mesh.
///
/// Several may apply to a node: holding takes precedence, the last motion counts, springs and
/// pressures add up.
struct Surroundings {
  /// Boundary conditions that only hold nodes.
  Surroundings(fem::FreeMask mask = {}) : free(std::move(mask)) {}  // NOLINT: is what it holds

  fem::FreeMask free;                 ///< 3 x n, in the world.
  std::vector<CarriedNodes> carried;  ///< Later entries take precedence.
  std::vector<SpringSupport> springs;
  std::vector<PressedFaces> pressures;

  /// Whether `free` is the only boundary condition.
  bool onlyHolds() const { return carried.empty() && springs.empty() && pressures.empty(); }
  /// Whether springs have damping.
  bool damps() const;
  /// Whether a cavity's content resists a change of volume.
  bool resistsVolumes() const;
};

/// Boundary conditions of a part of a body, given the part's nodes in the whole, ascending.
Surroundings partOf(const Surroundings& whole, const std::vector<int>& nodes);

}  // namespace palpate::tissue
