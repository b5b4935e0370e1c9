// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/solver/potential.h"

namespace palpate::solver {

/// The elastic part of a tangent, kept while the body has hardly changed its shape since it was
/// assembled. All other terms, and the scale of the elastic part, are always those of now.
class KeptStiffness {
 public:
  /// `pattern` is the body's.
  explicit KeptStiffness(const fem::Stiffness& pattern) : elastic_(pattern) {}

  /// As potential.hessian(), `A` of the body's pattern. True: with an elastic part that was there.
  bool hessian(const Potential& potential, const Points& x, fem::Tangent tangent,
               fem::Stiffness* A);
  /// The next one is assembled anew.
  void drop() { valid_ = false; }

 private:
  bool near(const Points& x) const;

  fem::Stiffness elastic_;  // exact in the elements, at x_, not scaled
  Points x_;
  bool valid_ = false;
};

}  // namespace palpate::solver
