// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <optional>

#include "prescribed_displacements.h"
#include "step_method.h"

namespace palpate::tissue {

/// The method of the system that palpate carries on from [Castillo Leon 2011, ch. 7], as a baseline
/// to compare with, not to use: quasi-static Newton-Raphson without a line search (a step is halved
/// only where the energy is not finite or grows far beyond what the tangent says), each system
/// assembled into an Eigen::SparseMatrix and solved by Eigen::BiCGSTAB with the diagonal as
/// preconditioner; contact is prescribed displacement, the tool's force the internal force at the
/// held nodes. What is held is on the tool: in contrast to the other methods contact is not
/// frictionless, and no penetration is left. The contact stiffness of the settings has no effect;
/// their model says whether the tool is a segment, as the source has it (SegmentContact), or
/// surface points inside any shape are put on it (PrescribedContact).
///
/// A cycle that fails is tried again with the tools' way cut into 2, 4 and 8 parts. One in which
/// nothing is held, and the energy grows, fails; so does one that is cut at a deadline and turns
/// held tissue inside out. The last step of a cut cycle leads down in energy, where no tool moves.
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
  Eigen::VectorXd diagonal_;  // of the last matrix, without signs
  double part_ = 0.0;         // of the cycle, where the tools are
  double residual_ = 0.0;
  double value_ = 0.0;                 // energy at x [J]
  std::optional<double> value_begin_;  // where the sweep began
  double curvature_ = 0.0;             // step . K step [J]
};

}  // namespace palpate::tissue
