// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "palpate/skin/plane_statics.h"

namespace palpate::skin {

enum class Diagonals {
  kOneWay,      ///< As published: the mesh has a handedness.
  kAlternating  ///< Mirrored from square to square: symmetric about the middle.
};

enum class Numbering { kColumns, kRows };  ///< Nodes follow each other down a column, along a row.

/// A flat block of skin over subcutis over bone, pressed in the middle of its top
/// [Triantafyllopoulos 2005, 1.4, 3.1]; the defaults are the source's. x goes right from the left
/// side, or from the axis of rings; z goes down from the top. The bottom and the sides are held.
struct TwoLayerBlock {
  double width = 0.012;           ///< Whole, also of rings [m]
  double height = 0.0045;         ///< [m]
  int columns = 16;               ///< Squares across the whole width; even
  int rows = 6;                   ///< Squares from top to bottom
  int upper_rows = 3;             ///< of which the upper layer has so many; in [1, rows - 1].
  double young_modulus = 0.2e6;   ///< Of the upper layer [Pa]
  double poisson_ratio = 0.48;    ///< Of both
  double stiffness_ratio = 10.0;  ///< Young's modulus of the upper over that of the lower layer
  double slab = 0.001;            ///< Across the plane, not of rings [m]: forces are those of it.
  double patch = 0.0;             ///< Half the width that is pressed [m]; 0: one node
  bool slides = true;             ///< What is pressed may move sideways, as published.
  Idealization idealization = Idealization::kPlaneStressPublished;
  Diagonals diagonals = Diagonals::kOneWay;
  Numbering numbering = Numbering::kColumns;
};

/// The number of rows above an interface at `fraction` of the height.
/// @throws InputError if that is inside an element, or at the top or the bottom.
int upperRows(double fraction, int rows);

/// @throws InputError for what makes no block: sizes, counts, constants, an edge of the patch
/// inside an element, more than 2 million nodes.
void checkBlock(const TwoLayerBlock& block);

/// Material 0 is the upper layer. @throws InputError as checkBlock().
PlaneMesh blockMesh(const TwoLayerBlock& block);

/// What a depth of 1 m gives; all is linear, so depth times it is what another depth gives.
struct UnitIndentation {
  TwoLayerBlock block;
  PlaneMesh mesh;
  PlanePoints displacement;  ///< 2 x n, z down
  double force;              ///< That presses the contact down, per depth [N/m]
  std::vector<int> surface;  ///< Top nodes from the left side, or the outer one of rings
  int band_width;            ///< See bandWidth()
};

/// Factored once. @throws InputError as checkBlock().
UnitIndentation indent(const TwoLayerBlock& block);

}  // namespace palpate::skin
