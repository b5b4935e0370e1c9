// SPDX-License-Identifier: GPL-3.0-or-later
#include "add_in_pairs.h"
#include "lane_vectors.h"
#include "palpate/base/lanes.h"
#include "quadratic_points.h"
#include "quadratic_stiffness.h"
#include "symmetric_lanes.h"
#include "tet_batch.h"
#include "tet_runs.h"

namespace palpate::fem::PALPATE_ISA {
namespace {

using Arrays = TetArrays<10>;
constexpr int kPoints = kTetPoints<10>;

inline double* jacobians(const Arrays& arrays, int batch, int q, int lane) {
  return arrays.J + kBatchSize * (kPoints * static_cast<long>(batch) + q) + lane;
}

// Viscous stress H at point q of the k-th batch of a run.
inline Symmetric viscousStress(const Arrays& arrays, const TetRun& run, int k, int q, int lane,
                               const MemorySlots& places) {
  const double* H = arrays.viscous[run.first_memory + kPoints * k].component[0] + q;
  Lanes c[6];
  for (int i = 0; i < 6; ++i) c[i] = gather(H + kBatchSize * i, places.at + lane);
  return {c[0], c[1], c[2], c[3], c[4], c[5]};
}

struct Loops {
  static void deform(const Arrays& arrays, const TetRun& run, const double* x,
                     double* volume_changes) {
    for (int k = 0; k < numBatches(run); ++k) {
      const int b = run.first_batch + k;
      const TetBatch<10>& batch = arrays.batches[b];
      double change[4][kBatchSize];
      for (int lane = 0; lane < kBatchSize; lane += kWidth) {
        const Quadratic e = quadraticAt(batch, lane, x);
        const Lanes volume = 0.25 * load(batch.volume + lane);
        Lanes dJ[kPoints], sum{};
        for (int q = 0; q < kPoints; ++q) {
          const Mat F = deformation(e, q);
          const Lanes J = dot(F.col[0], cross(F.col[1], F.col[2]));
          store(jacobians(arrays, b, q, lane), J);
          dJ[q] = volume * (J - 1.0);
          sum += dJ[q];
        }
        for (int a = 0; a < 4; ++a) store(change[a] + lane, kFar * sum + (kNear - kFar) * dJ[a]);
      }
      const TetPressures<10>& corners = arrays.pressures[b];
      for (int e = 0; e < countOf(run, k); ++e) {
        for (int a = 0; a < 4; ++a) volume_changes[corners.corner[a][e]] += change[a][e];
      }
    }
  }

  template <class Law, class Kind>
  static void energies(const Law law, Kind, const Arrays& arrays, const TetRun& run,
                       const double* x) {
    for (int k = 0; k < numBatches(run); ++k) {
      const int b = run.first_batch + k;
      const TetBatch<10>& batch = arrays.batches[b];
      const MemorySlots places = memorySlots(countOf(run, k));
      double energy[kBatchSize];
      for (int lane = 0; lane < kBatchSize; lane += kWidth) {
        const Quadratic e = quadraticAt(batch, lane, x);
        Lanes psi{};
        for (int q = 0; q < kPoints; ++q) {
          const Mat F = deformation(e, q);
          const Lanes J = dot(F.col[0], cross(F.col[1], F.col[2]));
          if (!arrays.pressures) store(jacobians(arrays, b, q, lane), J);
          psi += law.at(squaredNorm(F), J, Lanes{}).psi;
          if constexpr (Kind::kViscous) {
            const Symmetric H = viscousStress(arrays, run, k, q, lane, places);
            psi += viscousEnergy(H, F, times(F, H));
          }
        }
        store(energy + lane, 0.25 * load(batch.volume + lane) * psi);
      }
      arrays.energy[b] = sum(energy, countOf(run, k));
    }
  }

  // Forces of the 10 nodes from t_k(q) = V/4 P(q) grad w_k.
  static inline void storeForces(const Vec (*t)[4], int lane, double (*force)[kBatchSize]) {
    for (int i = 0; i < 3; ++i) {
      Lanes sum[4];
      for (int k = 0; k < 4; ++k) {
        sum[k] = (t[0][k].v[i] + t[1][k].v[i]) + (t[2][k].v[i] + t[3][k].v[i]);
        store(force[3 * k + i] + lane, kOnCorner * sum[k] + kMore * t[k][k].v[i]);
      }
      for (int a = 4; a < 10; ++a) {
        const int k = kEnds[a][0], l = kEnds[a][1];
        store(force[3 * a + i] + lane,
              kOnEdge * (sum[k] + sum[l]) + kMore * (t[l][k].v[i] + t[k][l].v[i]));
      }
    }
  }

  // V/4 A grad w_k for all corners.
  static inline void onGradients(const Mat& A, Lanes volume, const Vec* g, Vec* t) {
    t[0] = Vec{};
    for (int k = 0; k < 3; ++k) {
      t[k + 1] = times(A, g[k]);
      for (int i = 0; i < 3; ++i) t[k + 1].v[i] = volume * t[k + 1].v[i];
      t[0] = t[0] + t[k + 1];
    }
    t[0] = negative(t[0]);
  }

  template <class Law, class Kind>
  static void gradients(const Law law, Kind, const Arrays& arrays, const TetRun& run,
                        const double* x, const double* pressure, double* g) {
    for (int k = 0; k < numBatches(run); ++k) {
      const int b = run.first_batch + k;
      const TetBatch<10>& batch = arrays.batches[b];
      const int count = countOf(run, k);
      const MemorySlots places = memorySlots(count);
      double energy[kBatchSize], force[30][kBatchSize];
      for (int lane = 0; lane < kBatchSize; lane += kWidth) {
        const Quadratic e = quadraticAt(batch, lane, x);
        const CornerPressures p = cornerPressures(arrays.pressures, b, lane, pressure);
        const Lanes volume = 0.25 * load(batch.volume + lane);
        Lanes psi{};
        Vec t[kPoints][4];
        for (int q = 0; q < kPoints; ++q) {
          const Mat F = deformation(e, q);
          const Mat cof = cofactor(F);
          const Lanes J = dot(F.col[0], cof.col[0]);
          if (!pressure) store(jacobians(arrays, b, q, lane), J);
          const auto point = law.at(squaredNorm(F), J, p.at(q));
          psi += point.psi;
          Mat P;
          for (int j = 0; j < 3; ++j) {
            for (int i = 0; i < 3; ++i) {
              P.col[j].v[i] = point.f * F.col[j].v[i] + point.c * cof.col[j].v[i];
            }
          }
          if constexpr (Kind::kViscous) {
            const Symmetric H = viscousStress(arrays, run, k, q, lane, places);
            const Mat FH = times(F, H);
            psi += viscousEnergy(H, F, FH);
            for (int j = 0; j < 3; ++j) P.col[j] = P.col[j] + FH.col[j];
          }
          onGradients(P, volume, e.g, t[q]);
        }
        store(energy + lane, volume * psi);
        storeForces(t, lane, force);
      }
      arrays.energy[b] = sum(energy, count);
      addForces(force, batch, count, g);
    }
  }

  template <class Law, class Kind>
  static void hessians(const Law law, Kind, const Arrays& arrays, const TetRun& run,
                       const double* x, const double* pressure, double* blocks, double* rows) {
    for (int k = 0; k < numBatches(run); ++k) {
      const int b = run.first_batch + k;
      const TetBatch<10>& batch = arrays.batches[b];
      const int count = countOf(run, k);
      const MemorySlots places = memorySlots(count);
      CornerBlocks corner_blocks;
      double dilatation[4][30][kBatchSize];
      for (int lane = 0; lane < kBatchSize; lane += kWidth) {
        const Quadratic e = quadraticAt(batch, lane, x);
        const CornerPressures p = cornerPressures(arrays.pressures, b, lane, pressure);
        const Lanes volume = 0.25 * load(batch.volume + lane);
        Vec r[kPoints][4];
        for (int q = 0; q < kPoints; ++q) {
          const Mat F = deformation(e, q);
          const Mat cof = cofactor(F);
          const Lanes J = dot(F.col[0], cof.col[0]);
          const auto point = law.at(squaredNorm(F), J, p.at(q));
          Symmetric H{};
          if constexpr (Kind::kViscous) H = viscousStress(arrays, run, k, q, lane, places);
          const auto onIdentity = [&](const Vec& m, const Vec& n) {
            const Lanes elastic = point.f * dot(m, n);
            if constexpr (Kind::kViscous) return elastic + dot(m, times(H, n));
            return elastic;
          };
          corner_blocks.set(q, lane, point, volume, F, cof, e.g, onIdentity);
          if (pressure) onGradients(cof, volume, e.g, r[q]);
        }
        corner_blocks.sum(lane);
        if (pressure) storeDilatations(r, lane, dilatation);
      }
      corner_blocks.addTo(arrays.blocks[b], count, blocks);
      if (pressure) addDilatations(dilatation, arrays.pressures[b], count, rows);
    }
  }

  // Stresses, as for linear elements.
  template <class Law>
  static void stresses(const Law law, const Arrays& arrays, const TetRun& run, const double* x,
                       SymmetricBatch* S) {
    for (int k = 0; k < numBatches(run); ++k) {
      const TetBatch<10>& batch = arrays.batches[run.first_batch + k];
      const int count = countOf(run, k);
      const MemorySlots places = memorySlots(count);
      double* first = S[run.first_memory + kPoints * k].component[0];
      for (int q = 0; q < kPoints; ++q) {
        double out[6][kBatchSize];
        for (int lane = 0; lane < kBatchSize; lane += kWidth) {
          const Mat F = deformation(quadraticAt(batch, lane, x), q);
          storeDistortional(law, F, lane, out);
        }
        for (int e = 0; e < count; ++e) {
          for (int i = 0; i < 6; ++i) first[places.at[e] + kBatchSize * i + q] = out[i][e];
        }
      }
    }
  }
};

}  // namespace

extern const TetKernels<10> kQuadraticKernels;
const TetKernels<10> kQuadraticKernels = Table<10, Loops>::kernels();

}  // namespace palpate::fem::PALPATE_ISA
