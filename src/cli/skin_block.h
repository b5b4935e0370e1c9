// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/mesh/tet_mesh.h"
#include "palpate/skin/two_layer_block.h"

namespace palpate::cli {

/// The block in space: a square of `block.width` about the z axis, in `across` cells a side, from
/// the bone at z = 0 up, in the block's rows. Region 1 is the upper layer, 2 the lower one.
/// @throws InputError as skin::checkBlock(), and for `across` < 1 or more than 2 million cells.
mesh::TetMesh solidBlock(const skin::TwoLayerBlock& block, int across);

}  // namespace palpate::cli
