// SPDX-License-Identifier: GPL-3.0-or-later
#include "skin_block.h"

#include <string>

#include "palpate/base/error.h"

namespace palpate::cli {

mesh::TetMesh solidBlock(const skin::TwoLayerBlock& block, int across) {
  skin::checkBlock(block);
  if (across < 1 || static_cast<double>(across) * across * block.rows > 2e6) {
    throw InputError("command line", "--block", std::to_string(across),
                     "must be >= 1 and make no more than 2 million cells");
  }
  mesh::TetMesh solid =
      mesh::boxMesh(Vec3(block.width, block.width, block.height), {across, across, block.rows});
  solid.points.topRows<2>().array() -= 0.5 * block.width;
  const double interface = block.height * (block.rows - block.upper_rows) / block.rows;
  for (Eigen::Index t = 0; t < solid.numTets(); ++t) {
    double middle = 0.0;
    for (const int node : solid.tets.col(t)) middle += 0.25 * solid.points(2, node);
    solid.region.push_back(middle > interface ? 1 : 2);
  }
  return solid;
}

}  // namespace palpate::cli
