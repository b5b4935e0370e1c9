// SPDX-License-Identifier: GPL-3.0-or-later
#include "pcg_kernels.h"

namespace palpate::solver {

namespace baseline {
extern const PcgKernels kPcgKernels;
}
namespace avx2 {
extern const PcgKernels kPcgKernels;
}
namespace avx512 {
extern const PcgKernels kPcgKernels;
}

const PcgKernels& pcgKernels(Isa isa) {
  switch (isa) {
#ifdef PALPATE_X86_KERNELS
    case Isa::kAvx512:
      return avx512::kPcgKernels;
    case Isa::kAvx2:
      return avx2::kPcgKernels;
#endif
    default:
      return baseline::kPcgKernels;
  }
}

}  // namespace palpate::solver
