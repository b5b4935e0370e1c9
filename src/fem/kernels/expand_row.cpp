// SPDX-License-Identifier: GPL-3.0-or-later
#include "block_in_registers.h"
#include "tet_batch.h"

namespace palpate::fem::PALPATE_ISA {
namespace {

void expandRow(const int* index, int lower, int higher, const double* upper, double* row) {
  Block sum{};
  for (int k = 0; k < lower; ++k) {
    const Block A = transposed(loadBlock(upper + 9L * index[k]));
    storeBlock(A, row + 9L * k);
    sum = sum + A;
  }
  for (int k = lower + 1; k <= lower + higher; ++k) {
    const Block A = loadBlock(upper + 9L * index[k]);
    storeBlock(A, row + 9L * k);
    sum = sum + A;
  }
  storeBlock(-0.5 * (sum + transposed(sum)), row + 9L * lower);
}

}  // namespace

extern const ExpandRow kExpandRow;
const ExpandRow kExpandRow = expandRow;

}  // namespace palpate::fem::PALPATE_ISA
