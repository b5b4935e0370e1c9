// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/blas_rounding.h"

#include <cholmod.h>

#include <cmath>
#include <cstddef>
#include <cstdio>

#include "loaded_blas.h"
#include "palpate/base/content_hash.h"

namespace palpate::solver {

std::string blasKernels() {
  const auto name = loadedBlas<char* (*)()>("openblas_get_corename");
  return name == nullptr ? std::string() : std::string(name());
}

std::vector<double> blasProduct() {
  const auto dgemm = loadedBlas<Dgemm>("dgemm_");
  if (dgemm == nullptr) return {};
  constexpr int kSize = 150, kDepth = 1000;  // deeper than BLAS's blocks, whose size also differs
  std::vector<double> A(kSize * kDepth), C(kSize * kSize, 0.0);
  for (std::size_t k = 0; k < A.size(); ++k) A[k] = std::sin(static_cast<double>(k));
  const double one = 1.0, zero = 0.0;
  dgemm("N", "T", &kSize, &kSize, &kDepth, &one, A.data(), &kSize, A.data(), &kSize, &zero,
        C.data(), &kSize);
  return C;
}

std::string blasRounding() {
  const auto configuration = loadedBlas<char* (*)()>("openblas_get_config");
  const auto threads = loadedBlas<int (*)()>("openblas_get_num_threads");
  ContentHash answer(0);
  const std::vector<double> product = blasProduct();
  answer.add(product.data(), sizeof(double) * product.size());
  char text[20];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(answer.value()));
  return "CHOLMOD " + std::to_string(CHOLMOD_VERSION) + ", BLAS " +
         (configuration == nullptr ? "" : std::string(configuration()) + ", ") + blasKernels() +
         (threads == nullptr ? "" : ", " + std::to_string(threads()) + " threads") +
         ", a product of it " + text;
}

}  // namespace palpate::solver
