// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <dlfcn.h>

namespace palpate::solver {

/// A function of the BLAS of this process, whichever library the system's alternatives chose:
/// CHOLMOD calls the same. Null where the library has none of this name.
template <class Function>
Function loadedBlas(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, name));
}

using Dgemm = void (*)(const char*, const char*, const int*, const int*, const int*, const double*,
                       const double*, const int*, const double*, const int*, const double*, double*,
                       const int*);

}  // namespace palpate::solver
