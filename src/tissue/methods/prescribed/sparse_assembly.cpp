// SPDX-License-Identifier: GPL-3.0-or-later
#include "sparse_assembly.h"

#include <cmath>
#include <stdexcept>
#include <vector>

namespace palpate::tissue {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

void append(int i, int j, const Mat3& block, Triplets* triplets) {
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) triplets->emplace_back(3 * i + r, 3 * j + c, block(r, c));
  }
}

Eigen::SparseMatrix<double> assembleBlocks(const fem::Stiffness& stiffness) {
  const fem::BlockMatrix& K = stiffness.blocks();
  Triplets triplets;
  triplets.reserve(9 * static_cast<std::size_t>(K.numBlocks()));
  for (int i = 0; i < K.numNodes(); ++i) {
    for (int slot = K.rowBegin(i); slot < K.rowEnd(i); ++slot) {
      append(i, K.column(slot), K.block(slot), &triplets);
    }
  }
  for (const fem::Couplings::Block& block : stiffness.couplings().blocks()) {
    append(block.i, block.j, block.values, &triplets);
  }
  Eigen::SparseMatrix<double> A(3 * K.numNodes(), 3 * K.numNodes());
  A.setFromTriplets(triplets.begin(), triplets.end());
  return A;
}

// M^(1/2) B, a row a volume.
Eigen::SparseMatrix<double> scaledRows(const fem::VolumeStiffness& volume, int num_nodes) {
  Triplets triplets;
  for (Eigen::Index p = 0; p < volume.numRows(); ++p) {
    const double scale = std::sqrt(volume.factor * volume.metric->weights()[p]);
    for (int k = volume.pattern->start[p]; k < volume.pattern->start[p + 1]; ++k) {
      for (int c = 0; c < 3; ++c) {
        triplets.emplace_back(static_cast<int>(p), 3 * volume.pattern->node[k] + c,
                              scale * volume.rows(c, k));
      }
    }
  }
  Eigen::SparseMatrix<double> B(volume.numRows(), 3 * num_nodes);
  B.setFromTriplets(triplets.begin(), triplets.end());
  return B;
}

}  // namespace

Eigen::SparseMatrix<double> assembleSparse(const fem::Stiffness& K) {
  Eigen::SparseMatrix<double> A = assembleBlocks(K);
  if (!K.hasVolume()) return A;
  if (!K.volume().metric->isDiagonal()) {
    throw std::invalid_argument(
        "method newton_bicgstab cannot assemble element p1p1, whose "
        "pressures are coupled; take another element or method");
  }
  const Eigen::SparseMatrix<double> B = scaledRows(K.volume(), K.numNodes());
  const Eigen::SparseMatrix<double> volumes = B.transpose() * B;
  A += volumes;
  return A;
}

}  // namespace palpate::tissue
