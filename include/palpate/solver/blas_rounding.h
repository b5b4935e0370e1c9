// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace palpate::solver {

/// What OpenBLAS calls the processor that it computes for; "" of another BLAS.
std::string blasKernels();

/// A product of two matrices by the BLAS of this process, which cuts sums into parts by the sizes
/// of its kernels; empty where the process has no BLAS.
std::vector<double> blasProduct();

/// Names what decides the last bits of a factor in this process: versions of CHOLMOD and BLAS, the
/// BLAS's kernels and threads, and its answer. Processes with equal names round factors alike.
std::string blasRounding();

}  // namespace palpate::solver
