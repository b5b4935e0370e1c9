// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/for_all.h"
#include "palpate/solver/potential.h"

namespace palpate::solver {

/// The elastic part of a tangent, kept while the body has hardly changed its shape since it was
/// assembled. All other terms, and the scale of the elastic part, are always those of now.
class KeptStiffness {
 public:
  /// Change of an edge vector, as a part of its length, over which the elastic part is kept;
  /// docs/theory.md has what other values cost.
  static constexpr double kMostStrain = 0.05;
  /// The same within the cycle that it was assembled in.
  static constexpr double kMostStrainInCycle = 0.2;

  /// `pattern` is the body's; `pool` may be null and must outlive this.
  explicit KeptStiffness(const fem::Stiffness& pattern, ThreadPool* pool = nullptr)
      : elastic_(pattern), pool_(pattern.numNodes() >= kWorthThreads ? pool : nullptr) {}

  struct Assembled {
    bool kept;  ///< The elastic part was there.
    /// Slots off the diagonal that the call before may have left otherwise; null: any of them.
    /// Couplings are always those of now.
    const std::vector<int>* changed;
  };
  /// As potential.hessian(), then constrained by potential.free. `A` has the body's pattern and is
  /// the same at every call.
  Assembled hessian(const Potential& potential, const Points& x, fem::Tangent tangent,
                    fem::Stiffness* A);
  /// Where the elastic part was assembled is of an earlier cycle from here on.
  void beginCycle() { of_this_cycle_ = false; }
  /// The next one is assembled anew.
  void drop() { valid_ = false; }
  /// Somebody else has written into A.
  void matrixWasOverwritten() { in_matrix_ = false; }

  /// Where the elastic part was assembled, from which it can be assembled again; of a viscous body
  /// that depends on its memory of then, and the elastic part itself is saved.
  void save(StateWriter* out) const;
  void restore(StateReader* in);

 private:
  static constexpr int kWorthThreads = 1000;  // nodes: what one goes through in some microseconds

  bool near(const Points& x) const;
  bool inMatrix(const Potential& potential) const;
  /// A as it was before terms were added, all of it or where they were.
  void copy(fem::Stiffness* A) const;
  void restore(fem::BlockMatrix* A) const;

  fem::Stiffness elastic_;  // exact in the elements, at x_, not scaled
  ThreadPool* pool_;
  Points x_;
  bool valid_ = false;
  bool of_this_cycle_ = false;  // x_
  bool viscous_ = false;        // elastic_ depends on more than x_
  bool assembled_ = true;       // elastic_ is that of x_; false after a restore
  bool in_matrix_ = false;      // A is elastic_, scaled and constrained, and what terms added
  double scale_ = 1.0;
  fem::FreeMask free_;
  std::vector<int> changed_;
};

}  // namespace palpate::solver
