// SPDX-License-Identifier: GPL-3.0-or-later
#include "tet_kernels.h"

namespace palpate::fem {
namespace {

/// Kernels of one build.
struct Build {
  const TetKernels<4>& linear;
  const TetKernels<10>& quadratic;
  ExpandRow expand_row;
};

}  // namespace

#define PALPATE_BUILD(isa)                       \
  namespace isa {                                \
  extern const TetKernels<4> kTetKernels;        \
  extern const TetKernels<10> kQuadraticKernels; \
  extern const ExpandRow kExpandRow;             \
  }
PALPATE_BUILD(baseline)
PALPATE_BUILD(avx2)
PALPATE_BUILD(avx512)
#undef PALPATE_BUILD

namespace {

Build build(Isa isa) {
  switch (isa) {
#ifdef PALPATE_X86_KERNELS
    case Isa::kAvx512:
      return {avx512::kTetKernels, avx512::kQuadraticKernels, avx512::kExpandRow};
    case Isa::kAvx2:
      return {avx2::kTetKernels, avx2::kQuadraticKernels, avx2::kExpandRow};
#endif
    default:
      return {baseline::kTetKernels, baseline::kQuadraticKernels, baseline::kExpandRow};
  }
}

}  // namespace

template <>
const TetKernels<4>& tetKernels<4>(Isa isa) {
  return build(isa).linear;
}
template <>
const TetKernels<10>& tetKernels<10>(Isa isa) {
  return build(isa).quadratic;
}
ExpandRow expandRow(Isa isa) { return build(isa).expand_row; }

}  // namespace palpate::fem
