// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// For kernels only: common parts of loops over runs of elements.

#include "lane_vectors.h"
#include "tet_batch.h"
#include "tet_laws.h"

namespace palpate::fem {
namespace {

inline int countOf(const TetRun& run, int k) {
  const int left = run.num_elements - kBatchSize * k;
  return left < kBatchSize ? left : kBatchSize;
}
inline int numBatches(const TetRun& run) {
  return (run.num_elements + kBatchSize - 1) / kBatchSize;
}

// Whether a run's solid is viscous, as types: elastic runs have kernels without memory.
struct Elastic {
  static constexpr bool kViscous = false;
};
struct Viscous {
  static constexpr bool kViscous = true;
};

// Calls visit(law, Elastic or Viscous).
template <class Arrays, class Visit>
inline void forKind(const Arrays& arrays, const TetRun& run, const Visit& visit) {
  const auto withLaw = [&](auto law) {
    if (run.first_memory < 0) return visit(law, Elastic{});
    law.mu *= arrays.factor[run.solid];  // the distortional energy is proportional to mu
    visit(law, Viscous{});
  };
  if (run.law == TetLaw::kNeoHookean) return withLaw(NeoHookeanPoints{run.mu, run.kappa});
  withLaw(StableNeoHookeanPoints{run.mu, run.kappa});
}

// Calls visit(law) with the law of the distortional energy.
template <class Visit>
inline void forDistortional(const TetRun& run, const Visit& visit) {
  if (run.law == TetLaw::kNeoHookean) return visit(NeoHookeanPoints{run.mu, 0.0});
  visit(StableNeoHookeanPoints{run.mu, 0.0});
}

// Second Piola-Kirchhoff stress: with J C^-1 = cof(F)^T cof(F)/J, F^-1 (f F + c cof F) = f I + c/J
// cof(F)^T cof(F). Zero for det F <= kNoStress.
template <class Law>
inline void storeDistortional(const Law& law, const Mat& F, int lane, double (*out)[kBatchSize]) {
  const Mat cof = cofactor(F);
  const Lanes J = dot(F.col[0], cof.col[0]);
  const auto point = law.at(squaredNorm(F), J, Lanes{});
  const Lanes none{};
  const LaneBits any = J > Lanes{} + kNoStress;
  const Lanes f = select(any, point.f, none), c = select(any, point.c / J, none);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    store(out[i] + lane, f + c * dot(cof.col[i], cof.col[i]));
    store(out[3 + i] + lane, c * dot(cof.col[i], cof.col[j]));
  }
}

inline double sum(const double* values, int count) {
  double total = 0.0;
  for (int k = 0; k < count; ++k) total += values[k];
  return total;
}

// Kernels of elements with N nodes, from loops over the law and Elastic or Viscous.
template <int N, class Loops>
struct Table {
  using Arrays = TetArrays<N>;

  static void energy(const Arrays& arrays, const TetRun& run, const double* x) {
    forKind(arrays, run, [&](auto law, auto kind) { Loops::energies(law, kind, arrays, run, x); });
  }
  static void gradient(const Arrays& arrays, const TetRun& run, const double* x,
                       const double* pressure, double* g) {
    forKind(arrays, run,
            [&](auto law, auto kind) { Loops::gradients(law, kind, arrays, run, x, pressure, g); });
  }
  static void hessian(const Arrays& arrays, const TetRun& run, const double* x,
                      const double* pressure, double* blocks, double* rows) {
    forKind(arrays, run, [&](auto law, auto kind) {
      Loops::hessians(law, kind, arrays, run, x, pressure, blocks, rows);
    });
  }
  static void stress(const Arrays& arrays, const TetRun& run, const double* x, SymmetricBatch* S) {
    forDistortional(run, [&](auto law) { Loops::stresses(law, arrays, run, x, S); });
  }
  static constexpr TetKernels<N> kernels() {
    return {Loops::deform, energy, gradient, hessian, stress};
  }
};

}  // namespace
}  // namespace palpate::fem
