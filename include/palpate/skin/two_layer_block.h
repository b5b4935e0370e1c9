// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "palpate/skin/plane_statics.h"

namespace palpate::skin {

enum class Diagonals {
  kOneWay,      ///< As published: the mesh is not symmetric.
  kAlternating  ///< Mirrored between squares: symmetric about the middle.
};

enum class Numbering { kColumns, kRows };  ///< Order of nodes: down columns, or along rows.

/// A flat block of skin on subcutis on bone, pressed in the middle of its top [Triantafyllopoulos
/// 2005, 1.4, 3.1], with the source's defaults. x points right from the left side or the rings'
/// axis, z down from the top. Bottom and sides are held.
struct TwoLayerBlock {
  double width = 0.012;           ///< Full width, also of rings [m]
  double height = 0.0045;         ///< [m]
  int columns = 16;               ///< Squares across the full width; even
  int rows = 6;                   ///< Squares from top to bottom
  int upper_rows = 3;             ///< Rows of the upper layer, in [1, rows - 1].
  double young_modulus = 0.2e6;   ///< Of the upper layer [Pa]
  double poisson_ratio = 0.48;    ///< Of both layers
  double stiffness_ratio = 10.0;  ///< Young's modulus of the upper over that of the lower layer
  double slab = 0.001;            ///< Thickness [m] that forces refer to; not for rings.
  double patch = 0.0;             ///< Half the pressed width [m]; 0: one node
  bool slides = true;             ///< Pressed nodes may move sideways, as published.
  Idealization idealization = Idealization::kPlaneStressPublished;
  Diagonals diagonals = Diagonals::kOneWay;
  Numbering numbering = Numbering::kColumns;
};

/// Number of rows above an interface at `fraction` of the height.
/// @throws InputError if that is inside an element, or at the top or bottom.
int upperRows(double fraction, int rows);

/// @throws InputError for invalid sizes, counts or constants, an edge of the patch inside an
/// element, or more than 2 million nodes.
void checkBlock(const TwoLayerBlock& block);

/// Material 0 is the upper layer. @throws InputError as checkBlock().
PlaneMesh blockMesh(const TwoLayerBlock& block);

/// Response per depth of 1 m; all is linear in the depth.
struct UnitIndentation {
  TwoLayerBlock block;
  PlaneMesh mesh;
  PlanePoints displacement;  ///< 2 x n, z down
  double force;              ///< Force on the contact, downward, per depth [N/m]
  std::vector<int> surface;  ///< Top nodes from the left side, or from the outer side of rings
  int band_width;            ///< See bandWidth()
};

/// Factorised once. @throws InputError as checkBlock().
UnitIndentation indent(const TwoLayerBlock& block);

}  // namespace palpate::skin
