// SPDX-License-Identifier: GPL-3.0-or-later
#include "coarse_kernels.h"
#include "coarse_matrix_kernels.h"
#include "palpate/base/float_lanes.h"
#include "pcg_arrays.h"
#include "pcg_products.h"

namespace palpate::solver::PALPATE_ISA {
namespace {

void pack(const int* start, const PcgPart& part, int begin, int end, const double* values,
          float* to) {
  for (long k = start[begin]; k < start[end]; ++k) {
    for (int c = 0; c < part.count; ++c) {
      for (int lane = 0; lane < kSlice; lane += kWidth) {
        storeAsFloats(to + kSlice * (part.size * k + part.first + c) + lane,
                      gatherOrZero(values + c, part.from + kSlice * k + lane));
      }
    }
  }
}

// Diagonal blocks of B^T M B: sum of weight b b^T, xx xy yy xz yz zz.
inline void addDiagonal(const PcgVolumes& B, int s, int lane, FloatLanes* D) {
  for (long k = B.columns.start[s]; k < B.columns.start[s + 1]; ++k) {
    const FloatLanes weight = gather(B.weights, B.columns.source + kSlice * k + lane);
    FloatLanes b[3];
    for (int i = 0; i < 3; ++i) b[i] = load(B.columns.values + kSlice * (3 * k + i) + lane);
    for (int j = 0; j < 3; ++j) {
      const FloatLanes weighted = weight * b[j];
      for (int i = 0; i <= j; ++i) D[j * (j + 1) / 2 + i] += weighted * b[i];
    }
  }
}

// Positions of the upper triangle in a block of nine.
constexpr int kUpper[6] = {0, 3, 4, 6, 7, 8};

int invert(const double* values, const int* from, const PcgVolumes* B, int begin, int end,
           float* inverse_diagonal) {
  LaneBits definite = ~LaneBits{};
  for (int s = begin; s < end; ++s) {
    alignas(64) float volume[6][kSlice] = {};
    for (int lane = 0; B && lane < kSlice; lane += kFloatWidth) {
      FloatLanes D[6] = {};
      addDiagonal(*B, s, lane, D);
      for (int c = 0; c < 6; ++c) store(volume[c] + lane, D[c]);
    }
    float* out = inverse_diagonal + 6L * kSlice * s;
    for (int lane = 0; lane < kSlice; lane += kWidth) {
      Lanes D[6];
      for (int c = 0; c < 6; ++c) {
        D[c] = gather(values + kUpper[c], from + static_cast<long>(kSlice) * s + lane) +
               loadAsDoubles(volume[c] + lane);
      }
      const Lanes xx = D[0], xy = D[1], yy = D[2], xz = D[3], yz = D[4], zz = D[5];
      const Lanes cofactors[6] = {yy * zz - yz * yz, xz * yz - xy * zz, xx * zz - xz * xz,
                                  xy * yz - xz * yy, xy * xz - xx * yz, xx * yy - xy * xy};
      const Lanes determinant = xx * cofactors[0] + xy * cofactors[1] + xz * cofactors[3];
      // Sylvester's criterion on leading minors.
      definite &= (xx > 0.0) & (cofactors[5] > 0.0) & (determinant > 0.0);
      for (int c = 0; c < 6; ++c) {
        storeAsFloats(out + kSlice * c + lane, cofactors[c] / determinant);
      }
    }
  }
  long long all = -1;
  for (int lane = 0; lane < kWidth; ++lane) all &= definite[lane];
  return all != 0 ? 1 : 0;
}

void update(const float* inverse_diagonal, int begin, int end, double alpha, const PcgVectors& v,
            double* rz, double* rr) {
  LaneSums rz_sum, rr_sum;
  for (int s = begin; s < end; ++s) {
    for (int lane = 0; lane < kSlice; lane += kWidth) {
      const float* D = inverse_diagonal + 6L * kSlice * s + lane;
      const long first = 3L * kSlice * s + lane;
      Lanes r[3], d[6];
      for (int i = 0; i < 3; ++i) {
        const long at = first + kSlice * i;
        r[i] = load(v.r + at) - alpha * loadAsDoubles(v.Ap + at);
        store(v.r + at, r[i]);
      }
      for (int c = 0; c < 6; ++c) d[c] = loadAsDoubles(D + kSlice * c);
      const Lanes z[3] = {d[0] * r[0] + d[1] * r[1] + d[3] * r[2],
                          d[1] * r[0] + d[2] * r[1] + d[4] * r[2],
                          d[3] * r[0] + d[4] * r[1] + d[5] * r[2]};
      for (int i = 0; i < 3; ++i) storeAsFloats(v.z + first + kSlice * i, z[i]);
      rz_sum.add(lane, r[0] * z[0] + r[1] * z[1] + r[2] * z[2]);
      rr_sum.add(lane, r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
    }
  }
  *rz = rz_sum.total();
  *rr = rr_sum.total();
}

void direct(int begin, int end, double alpha, double beta, const PcgVectors& v,
            const PcgCoarse* coarse) {
  for (int s = begin; s < end; ++s) {
    alignas(64) float rounded[3 * kSlice];
    alignas(64) float motion[3 * kSlice];
    if (coarse) prolong(*coarse, s, motion);
    for (int lane = 0; lane < 3 * kSlice; lane += kWidth) {
      const long at = 3L * kSlice * s + lane;
      const Lanes last = load(v.p + at);
      Lanes z = loadAsDoubles(v.z + at);
      if (coarse) z += loadAsDoubles(motion + lane);
      const Lanes p = z + beta * last;
      store(v.x + at, load(v.x + at) + alpha * last);
      store(v.p + at, p);
      storeAsFloats(rounded + lane, p);
    }
    for (int lane = 0; lane < kSlice; lane += kFloatWidth) {
      FloatLanes p[3];
      for (int i = 0; i < 3; ++i) p[i] = load(rounded + kSlice * i + lane);
      storeNodes(p, v.p_nodes + kNodeStride * (static_cast<long>(kSlice) * s + lane));
    }
  }
}

}  // namespace

extern const PcgKernels kPcgKernels;
const PcgKernels kPcgKernels{
    pack,   multiply,   multiplyWithVolumes, changeOthers, addVolumes,    invert,     update,
    direct, restrictTo, addBlocks,           addSquare,    multiplyDense, invertDense};

}  // namespace palpate::solver::PALPATE_ISA
