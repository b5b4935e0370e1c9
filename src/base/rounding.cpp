// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/rounding.h"

#include <dlfcn.h>
#include <unistd.h>

#include <Eigen/Core>
#include <cstdint>
#include <cstdio>

#include "palpate/base/content_hash.h"

namespace palpate {
namespace {

// The C library has variants of these with and without fused multiply-add, and selects all alike.
// Results would tell less: most arguments give equal ones.
constexpr const char* kFunctions[] = {"sin",  "cos",  "tan",   "asin", "acos", "atan",  "atan2",
                                      "exp",  "exp2", "expm1", "log",  "log2", "log1p", "pow",
                                      "cbrt", "sinh", "cosh",  "tanh", "hypot"};

// Hash of the functions' addresses in their libraries.
std::uint64_t chosenFunctions() {
  ContentHash hash(0);
  for (const char* name : kFunctions) {
    void* function = dlsym(RTLD_DEFAULT, name);
    Dl_info library{};
    if (function == nullptr || dladdr(function, &library) == 0) continue;
    hash.add(reinterpret_cast<std::uintptr_t>(function) -
             reinterpret_cast<std::uintptr_t>(library.dli_fbase));
  }
  return hash.value();
}

std::string libraryVersion() {
  char version[64] = "C library";
#if defined(_CS_GNU_LIBC_VERSION)
  confstr(_CS_GNU_LIBC_VERSION, version, sizeof version);
#endif
  return version;
}

}  // namespace

std::string rounding() {
  char functions[20];
  std::snprintf(functions, sizeof functions, "%016llx",
                static_cast<unsigned long long>(chosenFunctions()));
  return std::string("Eigen with ") + Eigen::SimdInstructionSetsInUse() + ", " + libraryVersion() +
         " with functions " + functions;
}

}  // namespace palpate
