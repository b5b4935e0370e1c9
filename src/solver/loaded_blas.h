// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <dlfcn.h>

namespace palpate::solver {

/// A function of this process's BLAS, chosen by the system's alternatives and shared with CHOLMOD.
/// Null if the library lacks it.
template <class Function>
Function loadedBlas(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, name));
}

using Dgemm = void (*)(const char*, const char*, const int*, const int*, const int*, const double*,
                       const double*, const int*, const double*, const int*, const double*, double*,
                       const int*);

}  // namespace palpate::solver
