// SPDX-License-Identifier: GPL-3.0-or-later
#include "kept_stiffness.h"

#include <atomic>

namespace palpate::solver {
namespace {

enum class Saved : unsigned char { kNothing, kPlace, kAll };

}  // namespace

// The pattern has a block for each edge.
bool KeptStiffness::near(const Points& x) const {
  const fem::BlockMatrix& K = elastic_.blocks();
  const double strain = of_this_cycle_ ? kMostStrainInCycle : kMostStrain;
  const double strain_squared = strain * strain;
  std::atomic<bool> far{false};
  forAll(pool_, static_cast<std::size_t>(K.numNodes()), [&](std::size_t begin, std::size_t end) {
    for (auto i = static_cast<int>(begin); i < static_cast<int>(end); ++i) {
      if (far.load(std::memory_order_relaxed)) return;
      for (int slot = K.diagonal(i) + 1; slot < K.rowEnd(i); ++slot) {
        const int j = K.column(slot);
        const Vec3 then = x_.col(j) - x_.col(i);
        const Vec3 change = x.col(j) - x.col(i) - then;
        if (change.squaredNorm() > strain_squared * then.squaredNorm()) far = true;
      }
    }
  });
  return !far;
}

bool KeptStiffness::inMatrix(const Potential& potential) const {
  return in_matrix_ && scale_ == potential.elastic_scale && free_.cols() == potential.free.cols() &&
         free_ == potential.free;
}

void KeptStiffness::copy(fem::Stiffness* A) const {
  const double* from = elastic_.blocks().values();
  double* to = A->blocks().values();
  forAll(pool_, 9 * static_cast<std::size_t>(elastic_.blocks().numBlocks()),
         [&](std::size_t begin, std::size_t end) {
           for (std::size_t k = begin; k < end; ++k) to[k] = scale_ * from[k];
         });
  if (!elastic_.hasVolume()) return;
  A->volume() = elastic_.volume();
  A->volume().factor *= scale_;
}

void KeptStiffness::restore(fem::BlockMatrix* A) const {
  const fem::BlockMatrix& K = elastic_.blocks();
  forAll(pool_, static_cast<std::size_t>(K.numNodes()), [&](std::size_t begin, std::size_t end) {
    for (auto i = static_cast<int>(begin); i < static_cast<int>(end); ++i) {
      A->block(A->diagonal(i)) = scale_ * K.block(K.diagonal(i));
    }
  });
  for (int slot : A->added()) A->block(slot) = scale_ * K.block(slot);
}

KeptStiffness::Assembled KeptStiffness::hessian(const Potential& potential, const Points& x,
                                                fem::Tangent tangent, fem::Stiffness* A) {
  if (tangent == fem::Tangent::kProjected) {
    potential.hessian(x, tangent, A);
    A->constrain(potential.free);
    in_matrix_ = false;
    return {false, nullptr};
  }
  const bool kept = valid_ && near(x);
  if (!kept) {
    x_ = x;
    valid_ = of_this_cycle_ = true;
    viscous_ = potential.elasticity->viscous();
  }
  if (!kept || !assembled_) potential.elasticity->hessian(x_, fem::Tangent::kExact, &elastic_);
  assembled_ = true;
  fem::BlockMatrix& blocks = A->blocks();
  const bool in_matrix = kept && inMatrix(potential);
  if (in_matrix) {
    restore(&blocks);
    changed_ = blocks.added();
  } else {
    scale_ = potential.elastic_scale;
    free_ = potential.free;
    copy(A);
    changed_.clear();
  }
  A->forgetAdded();
  potential.addTermHessians(x, tangent, A);
  changed_.insert(changed_.end(), blocks.added().begin(), blocks.added().end());
  if (in_matrix) {
    A->constrainBlocks(potential.free);  // the volume stiffness is constrained already
  } else {
    A->constrain(potential.free);
  }
  in_matrix_ = true;
  return {kept, in_matrix ? &changed_ : nullptr};
}

void KeptStiffness::save(StateWriter* out) const {
  const Saved saved = !valid_ ? Saved::kNothing : viscous_ ? Saved::kAll : Saved::kPlace;
  out->put(saved);
  if (valid_) out->put(x_);
  if (saved == Saved::kAll) elastic_.save(out);
}

void KeptStiffness::restore(StateReader* in) {
  Saved saved = Saved::kNothing;
  in->get(&saved);
  if (saved > Saved::kAll) StateReader::fail();
  valid_ = saved != Saved::kNothing;
  viscous_ = assembled_ = saved == Saved::kAll;
  in_matrix_ = false;
  if (valid_) in->get(&x_);
  if (valid_ && x_.cols() != elastic_.numNodes()) StateReader::fail();
  if (saved == Saved::kAll) elastic_.restore(in);
}

}  // namespace palpate::solver
