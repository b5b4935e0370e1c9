// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <optional>

#include "prescribed_displacements.h"
#include "tissue/body/step_method.h"

namespace palpate::tissue {

/// The method of [Castillo Leon 2011, ch. 7] as a baseline for comparison: quasi-static
/// Newton-Raphson on Eigen::SparseMatrix with Eigen::BiCGSTAB and Jacobi preconditioner. There is
/// no line search; a step is halved only where the energy is not finite or far above the tangent's
/// prediction. Contact is prescribed displacement, and the tool's force the internal force at held
/// nodes, so contact sticks and leaves no penetration. contact.stiffness has no effect;
/// contact.model selects SegmentContact, as in the source, or PrescribedContact.
///
/// A failed cycle is repeated with the tool path cut into 2, 4 and 8 parts. A cycle fails where the
/// energy grows without holds, or where a deadline leaves held tissue inverted. The last step of a
/// cut cycle lowers the energy at fixed tools.
class PrescribedNewton final : public StepMethod {
 public:
  /// @throws std::invalid_argument for element p1p1.
  explicit PrescribedNewton(FemBody* body);

  bool advance(double dt, TissueStep* out) override;
  void reportForces(TissueStep* out) override;
  double unbalancedForce() override { return residual_; }
  bool restsInMinimum() override;
  const Eigen::VectorXd& masses() const override { return body_.elasticity->masses(); }
  void restart() override;
  void stop() override {}
  void save(StateWriter* out) const override;
  void restore(StateReader* in) override;

 private:
  bool sweep(int parts, TissueStep* out);
  void solveStage(double begin, TissueStep* out);
  void newton(TissueStep* out);
  bool isPlausible(bool held, const TissueStep& out);
  bool shorten(double most);
  void descend(double most);
  bool iterate(TissueStep* out);
  Eigen::SparseMatrix<double> assemble(TissueStep* out);
  bool solve(const Eigen::SparseMatrix<double>& A, TissueStep* out);
  double gradient();
  double energy(const Points& x);

  FemBody& body_;
  std::unique_ptr<PrescribedDisplacements> contact_;
  fem::Stiffness stiffness_;
  Points g_, move_, stiff_move_, right_, step_, trial_, x_begin_;
  Points held_way_, unused_;
  Eigen::VectorXd diagonal_;  // absolute diagonal of the last matrix
  double part_ = 0.0;         // fraction of the tool path
  double residual_ = 0.0;
  double value_ = 0.0;                 // energy at x [J]
  std::optional<double> value_begin_;  // at the begin of the tool path [J]
  double curvature_ = 0.0;             // step . K step [J]
};

}  // namespace palpate::tissue
