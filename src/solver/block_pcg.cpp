// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/block_pcg.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pcg_matrix.h"

namespace palpate::solver {
namespace {

// Relative residual that iterations with the packed matrix are trusted with.
constexpr double kSinglePrecision = 1e-4;
constexpr int kMaxRefinements = 10;

}  // namespace

struct BlockPcg::Impl {
  Impl(int iterations, ThreadPool* pool, Isa isa) : max_iterations(iterations), matrix(pool, isa) {}

  // Four doubles a node.
  void load(const Points& b) {
    const std::ptrdiff_t n = b.cols();
    if (vectors.rows() != 4 * n) {
      vectors.resize(4 * n, 5);
      p_single.setZero(4 * n);
    }
    vectors.setZero();
    Eigen::Map<Eigen::Matrix4Xd>(vectors.col(1).data(), 4, n).topRows<3>() = b;
    v = {vectors.col(0).data(), vectors.col(1).data(), vectors.col(2).data(),
         vectors.col(3).data(), vectors.col(4).data(), p_single.data()};
  }
  auto solution() const {
    return Eigen::Map<const Eigen::Matrix4Xd>(vectors.col(0).data(), 4, vectors.rows() / 4)
        .topRows<3>();
  }

  // From x = 0 to |r| <= target.
  SolveStatus iterate(const BlockPcg& asked, const Points& b, double target, int* iterations) {
    load(b);
    double rz = 0.0, rr = 0.0;
    matrix.update(0.0, v, &rz, &rr);
    matrix.direct(0.0, v);
    while (std::sqrt(rr) > target) {
      if (*iterations == max_iterations) return SolveStatus::kIterationLimit;
      if (asked.interrupted(*iterations)) return SolveStatus::kDeadline;
      const double curvature = matrix.apply(v);
      if (!std::isfinite(curvature)) return SolveStatus::kNonFinite;
      if (!(curvature > 0.0)) return SolveStatus::kNotPositiveDefinite;
      const double rz_last = rz;
      matrix.update(rz / curvature, v, &rz, &rr);
      matrix.direct(rz / rz_last, v);
      ++*iterations;
    }
    return SolveStatus::kConverged;
  }

  int max_iterations;
  PcgMatrix matrix;
  Eigen::Matrix<double, Eigen::Dynamic, 5> vectors;  // x, r, z, p, Ap
  Eigen::VectorXf p_single;
  PcgVectors v{};
  Points residual, Ax;
};

BlockPcg::BlockPcg(int max_iterations, ThreadPool* pool, Isa isa)
    : impl_(std::make_unique<Impl>(max_iterations, pool, isa)) {}
BlockPcg::~BlockPcg() = default;

LinearReport BlockPcg::solve(const fem::Stiffness& A, const Points& b, double relative_tolerance,
                             Points* x) {
  Impl& s = *impl_;
  LinearReport report;
  x->setZero(3, b.cols());
  const double target = relative_tolerance * b.norm();
  if (!std::isfinite(target)) return {SolveStatus::kNonFinite, 0};
  if (!s.matrix.assign(A)) return {SolveStatus::kNotPositiveDefinite, 0};
  report.status = s.iterate(*this, b, target, &report.iterations);
  *x = s.solution();
  if (relative_tolerance >= kSinglePrecision) return report;
  double last = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kMaxRefinements && report.status == SolveStatus::kConverged; ++k) {
    A.multiply(*x, &s.Ax);
    s.residual = b - s.Ax;
    const double norm = s.residual.norm();
    if (norm <= target || norm > 0.5 * last) break;
    last = norm;
    report.status = s.iterate(*this, s.residual, std::max(target, 1e-6 * norm), &report.iterations);
    *x += s.solution();
  }
  return report;
}

}  // namespace palpate::solver
