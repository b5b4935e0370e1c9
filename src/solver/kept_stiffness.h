// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/for_all.h"
#include "palpate/solver/potential.h"

namespace palpate::solver {

/// Keeps the elastic part of a tangent while the deformation changes little. All other terms, and
/// the scale of the elastic part, are current.
class KeptStiffness {
 public:
  /// Largest relative change of an edge vector for which the elastic part is kept; for the cost of
  /// other values see docs/theory.md.
  static constexpr double kMostStrain = 0.05;
  /// The same limit within the cycle of the assembly.
  static constexpr double kMostStrainInCycle = 0.2;

  /// `pattern` is the body's; `pool` may be null and must outlive this.
  explicit KeptStiffness(const fem::Stiffness& pattern, ThreadPool* pool = nullptr)
      : elastic_(pattern), pool_(pattern.numNodes() >= kWorthThreads ? pool : nullptr) {}

  struct Assembled {
    bool kept;  ///< Whether the elastic part was reused.
    /// Off-diagonal slots that may differ from the previous call; null: any. Couplings are always
    /// current.
    const std::vector<int>* changed;
  };
  /// As potential.hessian(), then constrained by potential.free. @pre `A` has the body's pattern
  /// and is the same object at every call.
  Assembled hessian(const Potential& potential, const Points& x, fem::Tangent tangent,
                    fem::Stiffness* A);
  /// Marks the kept part as one of an earlier cycle.
  void beginCycle() { of_this_cycle_ = false; }
  /// Requests assembly at the next call.
  void drop() { valid_ = false; }
  /// Declares that A was changed elsewhere.
  void matrixWasOverwritten() { in_matrix_ = false; }

  /// Saves the positions of the assembly, which is repeated on restore. For a viscous body, whose
  /// memory has changed since, the elastic part is saved, too.
  void save(StateWriter* out) const;
  void restore(StateReader* in);

 private:
  static constexpr int kWorthThreads = 1000;  // nodes; fewer take some microseconds

  bool near(const Points& x) const;
  bool inMatrix(const Potential& potential) const;
  /// Restores A as before terms were added, completely or where they were.
  void copy(fem::Stiffness* A) const;
  void restore(fem::BlockMatrix* A) const;

  fem::Stiffness elastic_;  // exact in the elements, at x_, unscaled
  ThreadPool* pool_;
  Points x_;
  bool valid_ = false;
  bool of_this_cycle_ = false;  // whether x_ is of this cycle
  bool viscous_ = false;        // elastic_ also depends on viscous memory
  bool assembled_ = true;       // whether elastic_ is assembled at x_; false after a restore
  bool in_matrix_ = false;      // A is elastic_, scaled and constrained, plus terms
  double scale_ = 1.0;
  fem::FreeMask free_;
  std::vector<int> changed_;
};

}  // namespace palpate::solver
