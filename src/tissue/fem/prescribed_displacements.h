// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <memory>

#include "fem_body.h"

namespace palpate::tissue {

/// Contact as a method sees it that prescribes displacements. All points are 3 x n, those of the
/// body [m].
class PrescribedDisplacements {
 public:
  virtual ~PrescribedDisplacements() = default;

  /// As new: nothing is held.
  virtual void clear() = 0;
  /// Keeps what is held, and goes back to that.
  virtual void keep() = 0;
  virtual void goBack() = 0;
  /// All that it remembers.
  virtual void save(StateWriter* to) const = 0;
  /// @throws std::invalid_argument for bytes of another body.
  virtual void restore(StateReader* from) = 0;

  /// Where the next stage ends, after part `s` of the cycle and up to `end`.
  virtual double nextStage(const Points& x, double s, double end) = 0;
  /// The tools are placed where the stage from part `s` of the cycle to `end` ends: what they still
  /// hold, they hold there.
  virtual void beginStage(const Points& x, double s, double end) = 0;
  /// Holds what is inside a tool at x; false if there is nothing new.
  virtual bool holdWhatPenetrates(const Points& x) = 0;
  /// Lets go what the tools pull at, given the gradient of all energies at x [N]; false if there is
  /// nothing.
  virtual bool release(const Points& x, const Points& gradient) = 0;
  /// The way that the holds ask of x; zero where nothing is held.
  virtual void moves(const Points& x, Points* move) const = 0;

  /// Whether anything is held.
  virtual bool holds() const = 0;
  /// 1 where neither the supports nor a tool hold a component, else 0.
  virtual const fem::FreeMask& free() const = 0;
  /// Norm of the gradient where nothing is held [N].
  virtual double unbalanced(const Points& gradient) const;
  /// Norm of what the tools exert on the nodes [N].
  virtual double nodalNorm(const Points& gradient) const = 0;
  /// The forces of the tissue on the tools.
  virtual void report(const Points& x, const Points& gradient, TissueStep* out) const = 0;
  /// Adds the searches since keep().
  virtual void addWork(TissueStep* /*out*/) const {}

  // Where components are held together, not one by one: Newton's system in the others.
  virtual void reduce(Eigen::SparseMatrix<double>* /*A*/) const {}
  virtual void reduce(Points* /*right*/) const {}
  virtual void expand(Points* /*step*/) const {}
};

/// That which body->settings name; the body outlives it.
std::unique_ptr<PrescribedDisplacements> makePrescribedDisplacements(FemBody* body);

}  // namespace palpate::tissue
