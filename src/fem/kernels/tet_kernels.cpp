// SPDX-License-Identifier: GPL-3.0-or-later
#include "tet_batch.h"

#include "add_in_pairs.h"
#include "lane_vectors.h"
#include "palpate/base/lanes.h"
#include "symmetric_lanes.h"
#include "tet_runs.h"
#include "tet_stiffness.h"

namespace palpate::fem::PALPATE_ISA {
namespace {

// Linear elements.
using Batch = TetBatch<4>;
using Blocks = TetBlocks<4>;
using Pressures = TetPressures<4>;
using Arrays = TetArrays<4>;

inline Vec shapeGradient(const Batch& batch, int a, int lane) {
  return {{load(batch.gradient[a][0] + lane), load(batch.gradient[a][1] + lane),
           load(batch.gradient[a][2] + lane)}};
}

// F = sum_a (x_a - x_0) (x) g_a.
inline Mat deformation(const Batch& batch, int lane, const double* x) {
  Mat F{};
  Vec origin;
  for (int i = 0; i < 3; ++i) origin.v[i] = gather(x + i, batch.node[0] + lane);
  for (int a = 0; a < 3; ++a) {
    Vec edge;
    for (int i = 0; i < 3; ++i) edge.v[i] = gather(x + i, batch.node[a + 1] + lane) - origin.v[i];
    for (int j = 0; j < 3; ++j) {
      const Lanes g = load(batch.gradient[a][j] + lane);
      for (int i = 0; i < 3; ++i) F.col[j].v[i] += edge.v[i] * g;
    }
  }
  return F;
}

inline Lanes meanPressure(const Pressures& corners, int lane, const double* pressure) {
  Lanes sum = gather(pressure, corners.corner[0] + lane);
  for (int a = 1; a < 4; ++a) sum += gather(pressure, corners.corner[a] + lane);
  return 0.25 * sum;
}

struct Loops {
  static void deform(const Arrays& arrays, const TetRun& run, const double* x,
                     double* volume_changes) {
    for (int k = 0; k < numBatches(run); ++k) {
      const int b = run.first_batch + k;
      const Batch& batch = arrays.batches[b];
      double change[kBatchSize];
      for (int lane = 0; lane < kBatchSize; lane += kWidth) {
        const Mat F = deformation(batch, lane, x);
        const Lanes J = dot(F.col[0], cross(F.col[1], F.col[2]));
        store(arrays.J + kBatchSize * static_cast<long>(b) + lane, J);
        store(change + lane, 0.25 * load(batch.volume + lane) * (J - 1.0));
      }
      const Pressures& corners = arrays.pressures[b];
      for (int e = 0; e < countOf(run, k); ++e) {
        for (int a = 0; a < 4; ++a) volume_changes[corners.corner[a][e]] += change[e];
      }
    }
  }

  template <class Law, class Kind>
  static void energies(const Law law, Kind, const Arrays& arrays, const TetRun& run,
                       const double* x) {
    for (int k = 0; k < numBatches(run); ++k) {
      const int b = run.first_batch + k;
      const Batch& batch = arrays.batches[b];
      double energy[kBatchSize];
      for (int lane = 0; lane < kBatchSize; lane += kWidth) {
        const Mat F = deformation(batch, lane, x);
        const Lanes J = dot(F.col[0], cross(F.col[1], F.col[2]));
        if (!arrays.pressures) store(arrays.J + kBatchSize * static_cast<long>(b) + lane, J);
        auto point = law.at(squaredNorm(F), J, Lanes{});
        if constexpr (Kind::kViscous) {
          const Symmetric H = loadSymmetric(arrays.viscous[run.first_memory + k], lane);
          point.psi += viscousEnergy(H, F, times(F, H));
        }
        store(energy + lane, load(batch.volume + lane) * point.psi);
      }
      arrays.energy[b] = sum(energy, countOf(run, k));
    }
  }

  template <class Law, class Kind>
  static void gradients(const Law law, Kind, const Arrays& arrays, const TetRun& run,
                        const double* x, const double* pressure, double* g) {
    for (int k = 0; k < numBatches(run); ++k) {
      const int b = run.first_batch + k;
      const Batch& batch = arrays.batches[b];
      double energy[kBatchSize], force[12][kBatchSize];
      for (int lane = 0; lane < kBatchSize; lane += kWidth) {
        const Mat F = deformation(batch, lane, x);
        const Mat cof = cofactor(F);
        const Lanes J = dot(F.col[0], cof.col[0]);
        if (!pressure) store(arrays.J + kBatchSize * static_cast<long>(b) + lane, J);
        const Lanes p = pressure ? meanPressure(arrays.pressures[b], lane, pressure) : Lanes{};
        auto point = law.at(squaredNorm(F), J, p);
        const Lanes volume = load(batch.volume + lane);
        Mat P;
        for (int j = 0; j < 3; ++j) {
          for (int i = 0; i < 3; ++i) {
            P.col[j].v[i] = point.f * F.col[j].v[i] + point.c * cof.col[j].v[i];
          }
        }
        if constexpr (Kind::kViscous) {
          const Symmetric H = loadSymmetric(arrays.viscous[run.first_memory + k], lane);
          const Mat FH = times(F, H);
          point.psi += viscousEnergy(H, F, FH);
          for (int j = 0; j < 3; ++j) P.col[j] = P.col[j] + FH.col[j];
        }
        store(energy + lane, volume * point.psi);
        for (int j = 0; j < 3; ++j) {
          for (int i = 0; i < 3; ++i) P.col[j].v[i] = volume * P.col[j].v[i];
        }
        Vec last{};
        for (int a = 0; a < 3; ++a) {
          const Vec f = times(P, shapeGradient(batch, a, lane));
          last = last + f;
          for (int i = 0; i < 3; ++i) store(force[3 * a + 3 + i] + lane, f.v[i]);
        }
        for (int i = 0; i < 3; ++i) store(force[i] + lane, -last.v[i]);
      }
      const int count = countOf(run, k);
      arrays.energy[b] = sum(energy, count);
      addForces(force, batch, count, g);
    }
  }

  template <class Law, class Kind>
  static void hessians(const Law law, Kind, const Arrays& arrays, const TetRun& run,
                       const double* x, const double* pressure, double* blocks, double* rows) {
    for (int k = 0; k < numBatches(run); ++k) {
      const int b = run.first_batch + k;
      const Batch& batch = arrays.batches[b];
      alignas(64) double values[54][kBatchSize];
      double dilatation[12][kBatchSize];
      for (int lane = 0; lane < kBatchSize; lane += kWidth) {
        const Mat F = deformation(batch, lane, x);
        const Mat cof = cofactor(F);
        const Lanes J = dot(F.col[0], cof.col[0]);
        const Lanes p = pressure ? meanPressure(arrays.pressures[b], lane, pressure) : Lanes{};
        const auto point = law.at(squaredNorm(F), J, p);
        const Lanes volume = load(batch.volume + lane);
        const Lanes spin = volume * point.c;
        Vec g[3], f[3], c[3], h[3];
        for (int a = 0; a < 3; ++a) {
          g[a] = shapeGradient(batch, a, lane);
          f[a] = times(F, g[a]);
          c[a] = times(cof, g[a]);
        }
        if constexpr (Kind::kViscous) {
          const Symmetric H = loadSymmetric(arrays.viscous[run.first_memory + k], lane);
          for (int a = 0; a < 3; ++a) h[a] = times(H, g[a]);
        }
        const auto onIdentity = [&](int m, int n) {
          const Lanes elastic = point.f * dot(g[m], g[n]);
          if constexpr (Kind::kViscous) return elastic + dot(g[m], h[n]);
          return elastic;
        };
        const Mat K11 = block(point, volume, onIdentity(0, 0), f[0], c[0], f[0], c[0]);
        const Mat K22 = block(point, volume, onIdentity(1, 1), f[1], c[1], f[1], c[1]);
        const Mat K33 = block(point, volume, onIdentity(2, 2), f[2], c[2], f[2], c[2]);
        Mat K12 = block(point, volume, onIdentity(0, 1), f[0], c[0], f[1], c[1]);
        addSpin(spin, times(F, cross(g[0], g[1])), &K12);
        Mat K13 = block(point, volume, onIdentity(0, 2), f[0], c[0], f[2], c[2]);
        addSpin(spin, times(F, cross(g[0], g[2])), &K13);
        Mat K23 = block(point, volume, onIdentity(1, 2), f[1], c[1], f[2], c[2]);
        addSpin(spin, times(F, cross(g[1], g[2])), &K23);
        const Mat K01 = minusSum(K11, transposed(K12), transposed(K13));
        const Mat K02 = minusSum(K12, K22, transposed(K23));
        const Mat K03 = minusSum(K13, K23, K33);
        const Mat* above[6] = {&K01, &K02, &K03, &K12, &K13, &K23};
        for (int n = 0; n < 6; ++n) storeBlock(*above[n], values + 9 * n, lane);
        if (!pressure) continue;
        const Vec c0 = negative(c[0] + c[1] + c[2]);
        const Lanes quarter = 0.25 * volume;
        for (int i = 0; i < 3; ++i) {
          store(dilatation[i] + lane, quarter * c0.v[i]);
          for (int a = 0; a < 3; ++a) store(dilatation[3 * a + 3 + i] + lane, quarter * c[a].v[i]);
        }
      }
      const int count = countOf(run, k);
      const Blocks& where = arrays.blocks[b];
      for (int n = 0; n < 6; ++n) addNines(values + 9 * n, where.offset[n], count, blocks);
      if (!pressure) continue;
      addRows(dilatation, arrays.pressures[b].row, count, rows);
    }
  }

  template <class Law>
  static void stresses(const Law law, const Arrays& arrays, const TetRun& run, const double* x,
                       SymmetricBatch* S) {
    for (int k = 0; k < numBatches(run); ++k) {
      const Batch& batch = arrays.batches[run.first_batch + k];
      for (int lane = 0; lane < kBatchSize; lane += kWidth) {
        storeDistortional(law, deformation(batch, lane, x), lane,
                          S[run.first_memory + k].component);
      }
    }
  }
};

}  // namespace

extern const TetKernels<4> kTetKernels;
const TetKernels<4> kTetKernels = Table<4, Loops>::kernels();

}  // namespace palpate::fem::PALPATE_ISA
