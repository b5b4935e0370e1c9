// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/block_pcg.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "palpate/solver/unit_costs.h"
#include "pcg_matrix.h"

namespace palpate::solver {
namespace {

// Relative residual that iterations in single precision can reach.
constexpr double kSinglePrecision = 1e-4;
constexpr int kMaxRefinements = 10;

}  // namespace

struct BlockPcg::Impl {
  Impl(int iterations, PcgMatrix&& of) : max_iterations(iterations), matrix(std::move(of)) {}

  // Sets r = b and the rest to 0.
  void load(const Points& b) {
    const SliceOrder& nodes = matrix.nodes();
    const std::size_t lanes = static_cast<std::size_t>(kSlice) * nodes.numSlices();
    for (auto* vector : {&x, &r, &p}) vector->assign(3 * lanes, 0.0);
    for (auto* vector : {&z, &Ap}) vector->assign(3 * lanes, 0.0F);
    p_nodes.assign(kNodeStride * lanes, 0.0F);
    v = {x.data(), r.data(), p.data(), z.data(), Ap.data(), p_nodes.data()};
    for (int i = 0; i < nodes.count(); ++i) {
      double* r_i = v.r + nodes.offset(i, 3);
      for (int c = 0; c < 3; ++c) r_i[kSlice * c] = b(c, i);
    }
  }
  template <class Take>
  void forNodes(const double* vector, const Take& take) const {
    const SliceOrder& nodes = matrix.nodes();
    for (int i = 0; i < nodes.count(); ++i) {
      const double* at = vector + nodes.offset(i, 3);
      take(i, Vec3(at[0], at[kSlice], at[2 * kSlice]));
    }
  }
  template <class Take>
  void forSolution(const Take& take) const {
    forNodes(v.x, take);
  }

  // p . A p of the last direction, in double precision.
  double curvature(const fem::Stiffness& A) {
    residual.resize(3, matrix.nodes().count());
    forNodes(v.p, [&](int i, const Vec3& p_i) { residual.col(i) = p_i; });
    A.blocks().multiply(residual, &Ax);
    A.couplings().addProduct(residual, &Ax);
    A.rankOnes().addProduct(residual, &Ax);
    const double of_blocks = residual.cwiseProduct(Ax).sum();
    if (!A.hasVolume()) return of_blocks;
    const fem::VolumeStiffness& volume = A.volume();
    volume.multiplyRows(residual, &changes);
    volume.metric->apply(changes, &pressures);
    return of_blocks + volume.factor * changes.dot(pressures);
  }

  // Iterates from x = 0 to |r| <= target.
  SolveStatus iterate(const BlockPcg& asked, const Points& b, double target, int* iterations) {
    load(b);
    double rz = 0.0, rr = 0.0;
    matrix.update(0.0, v, &rz, &rr);
    matrix.direct(0.0, 0.0, v);
    while (std::sqrt(rr) > target) {
      if (*iterations == max_iterations) return SolveStatus::kIterationLimit;
      if (asked.interrupted(*iterations)) return SolveStatus::kDeadline;
      const double curvature = matrix.apply(v);
      if (!std::isfinite(curvature)) return SolveStatus::kNonFinite;
      // The present solution is a descent direction [Nocedal, Wright 2006, alg. 7.1].
      if (!(curvature > 0.0)) {
        return *iterations > 0 ? SolveStatus::kIterationLimit : SolveStatus::kNotPositiveDefinite;
      }
      const double rz_last = rz, alpha = rz / curvature;
      matrix.update(alpha, v, &rz, &rr);
      matrix.direct(alpha, rz / rz_last, v);
      ++*iterations;
    }
    return SolveStatus::kConverged;
  }

  int max_iterations;
  PcgMatrix matrix;
  AlignedVector<double> x, r, p;
  AlignedVector<float> z, Ap, p_nodes;
  PcgVectors v{};
  Points residual, Ax;
  Eigen::VectorXd changes, pressures;
  const std::vector<int>* changed = nullptr;  // slots of the next matrix, see onlyChanged()
  bool current = false;                       // whether the last matrix is packed
};

BlockPcg::BlockPcg(int max_iterations, ThreadPool* pool, Isa isa, const Points& points)
    : impl_(std::make_unique<Impl>(max_iterations, PcgMatrix(pool, isa, points))) {}
BlockPcg::BlockPcg(int max_iterations, ThreadPool* pool, const std::vector<BlockPcg*>& bodies) {
  std::vector<PcgMatrix*> matrices;
  matrices.reserve(bodies.size());
  for (BlockPcg* body : bodies) matrices.push_back(&body->impl_->matrix);
  impl_ = std::make_unique<Impl>(max_iterations, PcgMatrix(pool, bestIsa(), matrices));
}
BlockPcg::BlockPcg(BlockPcg&&) noexcept = default;
BlockPcg::~BlockPcg() = default;

void BlockPcg::takePattern(const fem::Stiffness& A) { impl_->matrix.takePattern(A); }

bool BlockPcg::learnsFromRest(bool lasting) const { return impl_->matrix.wantsCoarse(lasting); }

void BlockPcg::learnFromRest(const fem::Stiffness& A) { impl_->matrix.addCoarse(A); }

void BlockPcg::onlyChanged(const std::vector<int>& slots) { impl_->changed = &slots; }

double BlockPcg::iterationSeconds(const fem::Stiffness& A) {
  const double volume_entries = A.hasVolume() ? static_cast<double>(A.volume().rows.cols()) : 0.0;
  return pcgIterationSeconds(A.blocks().numBlocks(), volume_entries);
}

LinearReport BlockPcg::solve(const fem::Stiffness& A, const Points& b, double relative_tolerance,
                             Points* x) {
  Impl& s = *impl_;
  LinearReport report;
  x->setZero(3, b.cols());
  const double target = relative_tolerance * b.norm();
  const std::vector<int>* changed = std::exchange(s.changed, nullptr);
  if (!std::exchange(s.current, false)) changed = nullptr;
  if (!std::isfinite(target)) return {SolveStatus::kNonFinite, 0};
  const bool definite = s.matrix.assign(A, changed);
  s.current = true;
  if (!definite) return {SolveStatus::kNotPositiveDefinite, 0};
  report.status = s.iterate(*this, b, target, &report.iterations);
  s.forSolution([&](int i, const Vec3& x_i) { x->col(i) = x_i; });
  if (report.status == SolveStatus::kIterationLimit) {
    report.in_vain = report.iterations == s.max_iterations || s.curvature(A) > 0.0;
  }
  if (relative_tolerance >= kSinglePrecision) return report;
  double last = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kMaxRefinements && report.status == SolveStatus::kConverged; ++k) {
    A.multiply(*x, &s.Ax);
    s.residual = b - s.Ax;
    const double norm = s.residual.norm();
    if (norm <= target || norm > 0.5 * last) break;
    last = norm;
    report.status = s.iterate(*this, s.residual, std::max(target, 1e-6 * norm), &report.iterations);
    s.forSolution([&](int i, const Vec3& x_i) { x->col(i) += x_i; });
  }
  return report;
}

}  // namespace palpate::solver
