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

/// Nodes, all components of which are held, that are carried along a motion.
struct CarriedNodes {
  std::vector<int> nodes;  ///< Ascending.
  Motion motion;
};

/// Springs on the boundary faces of which all corners are among `nodes`, anchored where these are
/// at rest, or carried along a motion.
struct SpringSupport {
  std::vector<int> nodes;  ///< Ascending.
  fem::FoundationConstants constants;
  std::optional<Motion> motion;
};

/// Pressure on the boundary faces of which all corners are among `nodes`.
struct PressedFaces {
  std::vector<int> nodes;  ///< Ascending.
  fem::CavityContent content;
};

/// What an organ's surroundings do to it beside gravity and tools, on the nodes of a mesh of it.
///
/// Several may meet in a node. What is held is held, whatever else there is; of the motions that
/// would carry it the last one does; springs and pressures add up.
struct Surroundings {
  /// Held, and no more.
  Surroundings(fem::FreeMask mask = {}) : free(std::move(mask)) {}  // NOLINT: is what it holds

  fem::FreeMask free;                 ///< 3 x n, in the world.
  std::vector<CarriedNodes> carried;  ///< Of later ones over earlier ones.
  std::vector<SpringSupport> springs;
  std::vector<PressedFaces> pressures;

  /// Whether it is all in `free`.
  bool onlyHolds() const { return carried.empty() && springs.empty() && pressures.empty(); }
  /// Whether springs lose energy.
  bool damps() const;
  /// Whether a content resists a change of its volume.
  bool resistsVolumes() const;
};

/// What a part of a body has of it, whose nodes are these of the whole, ascending.
Surroundings partOf(const Surroundings& whole, const std::vector<int>& nodes);

}  // namespace palpate::tissue
