// SPDX-License-Identifier: GPL-3.0-or-later
#include "tet_kernels.h"

namespace palpate::fem {

namespace baseline {
extern const TetKernels kTetKernels;
}
namespace avx2 {
extern const TetKernels kTetKernels;
}
namespace avx512 {
extern const TetKernels kTetKernels;
}

const TetKernels& tetKernels(Isa isa) {
  switch (isa) {
#ifdef PALPATE_X86_KERNELS
    case Isa::kAvx512:
      return avx512::kTetKernels;
    case Isa::kAvx2:
      return avx2::kTetKernels;
#endif
    default:
      return baseline::kTetKernels;
  }
}

}  // namespace palpate::fem
