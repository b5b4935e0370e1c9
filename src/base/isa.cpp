// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/isa.h"

#include "detect_isas.h"

namespace palpate {

std::vector<Isa> detectIsas() {
  std::vector<Isa> isas{Isa::kBaseline};
#ifdef PALPATE_X86_KERNELS
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) isas.push_back(Isa::kAvx2);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw")) {
    isas.push_back(Isa::kAvx512);
  }
#endif
  return isas;
}

std::string_view toString(Isa isa) {
  switch (isa) {
    case Isa::kAvx2:
      return "AVX2";
    case Isa::kAvx512:
      return "AVX-512";
    default:
      return "baseline";
  }
}

}  // namespace palpate
