// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <memory>

#include "tissue/body/fem_body.h"

namespace palpate::tissue {

/// Contact by prescribed displacements. All points are those of the body, 3 x n [m].
class PrescribedDisplacements {
 public:
  virtual ~PrescribedDisplacements() = default;

  /// Clears the state: nothing is held.
  virtual void clear() = 0;
  /// Stores the holds, and rolls back to them.
  virtual void keep() = 0;
  virtual void goBack() = 0;
  /// Writes the state.
  virtual void save(StateWriter* to) const = 0;
  /// @throws std::invalid_argument for bytes of another body.
  virtual void restore(StateReader* from) = 0;

  /// End of the next stage, a fraction of the cycle in (s, end].
  virtual double nextStage(const Points& x, double s, double end) = 0;
  /// Begins the stage from fraction `s` of the cycle to `end`; holds move with the tools.
  /// @pre The tools are at the stage's end.
  virtual void beginStage(const Points& x, double s, double end) = 0;
  /// Holds samples inside a tool at x. Returns false without a new one.
  virtual bool holdWhatPenetrates(const Points& x) = 0;
  /// Releases samples in tension; `gradient`: of all energies at x, 3 x n [N]. Returns false
  /// without any.
  virtual bool release(const Points& x, const Points& gradient) = 0;
  /// Displacement from x to the held positions, 3 x n [m]; zero where nothing is held.
  virtual void moves(const Points& x, Points* move) const = 0;

  /// Whether anything is held.
  virtual bool holds() const = 0;
  /// 1 where neither the supports nor a tool hold a component, else 0.
  virtual const fem::FreeMask& free() const = 0;
  /// Norm of `gradient` over the free components [N].
  virtual double unbalanced(const Points& gradient) const;
  /// Norm of the tools' nodal forces [N].
  virtual double nodalNorm(const Points& gradient) const = 0;
  /// Adds the contacts, with forces of the tissue on the tools, to `out`.
  virtual void report(const Points& x, const Points& gradient, TissueStep* out) const = 0;
  /// Adds counts of surface searches since keep() to `out`.
  virtual void addWork(TissueStep* /*out*/) const {}

  // For holds of linear combinations of components: reduction of Newton's system.
  virtual void reduce(Eigen::SparseMatrix<double>* /*A*/) const {}
  virtual void reduce(Points* /*right*/) const {}
  virtual void expand(Points* /*step*/) const {}
};

/// Makes the kind that body->settings name.
/// @pre The body outlives the result.
std::unique_ptr<PrescribedDisplacements> makePrescribedDisplacements(FemBody* body);

}  // namespace palpate::tissue
