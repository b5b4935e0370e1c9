// SPDX-License-Identifier: GPL-3.0-or-later
#include "spring_kernels.h"

namespace palpate::tissue {

namespace baseline {
extern const SpringKernel kSpringKernel;
}
namespace avx2 {
extern const SpringKernel kSpringKernel;
}
namespace avx512 {
extern const SpringKernel kSpringKernel;
}

SpringKernel springKernel(Isa isa) {
  switch (isa) {
#ifdef PALPATE_X86_KERNELS
    case Isa::kAvx512:
      return avx512::kSpringKernel;
    case Isa::kAvx2:
      return avx2::kSpringKernel;
#endif
    default:
      return baseline::kSpringKernel;
  }
}

}  // namespace palpate::tissue
