// SPDX-License-Identifier: GPL-3.0-or-later
#include "kept_stiffness.h"

namespace palpate::solver {
namespace {

// Change of an edge vector, of its length, that the elastic part is kept over.
constexpr double kStrain = 0.02;

// A = s K, of one pattern.
void scaledCopy(const fem::Stiffness& K, double s, fem::Stiffness* A) {
  const double* from = K.blocks().values();
  const std::ptrdiff_t count = 9 * static_cast<std::ptrdiff_t>(K.blocks().numBlocks());
  double* to = A->blocks().values();
  for (std::ptrdiff_t k = 0; k < count; ++k) to[k] = s * from[k];
  if (!K.hasVolume()) return;
  A->volume() = K.volume();
  A->volume().factor *= s;
}

}  // namespace

// The pattern has a block for every edge.
bool KeptStiffness::near(const Points& x) const {
  const fem::BlockMatrix& K = elastic_.blocks();
  const double strain_squared = kStrain * kStrain;
  for (int i = 0; i < K.numNodes(); ++i) {
    for (int slot = K.diagonal(i) + 1; slot < K.rowEnd(i); ++slot) {
      const int j = K.column(slot);
      const Vec3 then = x_.col(j) - x_.col(i);
      const Vec3 change = x.col(j) - x.col(i) - then;
      if (change.squaredNorm() > strain_squared * then.squaredNorm()) return false;
    }
  }
  return true;
}

bool KeptStiffness::hessian(const Potential& potential, const Points& x, fem::Tangent tangent,
                            fem::Stiffness* A) {
  if (tangent == fem::Tangent::kProjected) {
    potential.hessian(x, tangent, A);
    return false;
  }
  const bool kept = valid_ && near(x);
  if (!kept) {
    potential.elasticity->hessian(x, tangent, &elastic_);
    x_ = x;
    valid_ = true;
  }
  scaledCopy(elastic_, potential.elastic_scale, A);
  for (const fem::EnergyTerm* term : potential.terms) term->addHessian(x, tangent, &A->blocks());
  return kept;
}

}  // namespace palpate::solver
