// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/enrichment/surrogate.h"
#include "palpate/tissue/model_settings.h"
#include "palpate/tissue/neural/neural_settings.h"
#include "palpate/tissue/tissue_model.h"
#include "surrogate_shape.h"
#include "tool_press.h"

namespace palpate::tissue {

/// Parts of an organ of model neural.
struct NeuralParts {
  std::unique_ptr<TissueModel> elements;  ///< The organ by linear finite elements.
  enrichment::Surrogate surrogate;
  mesh::CellMesh body;  ///< Rest configuration, organ's frame [m].
  fem::FreeMask free;   ///< Free components of the points, 3 x n.
  Pose X_WO;
};

/// An organ that evaluates a surrogate for learned presses, and finite elements for others.
///
/// The first tool in contact is evaluated at its deepest point in the surface of the initial
/// equilibrium, with the displacement of that point onto the tool. The surrogate's force is of a
/// pressure on a patch of radius p; for a ball of radius R at depth d it is scaled by
///
///     s = 32 sqrt(R d) / (9 pi p),
///
/// the ratio of Hertz's force to that of the patch for equal displacement of the middle on a half
/// space [Johnson 1985, secs. 3.4, 4.2]. The force is normal to the tool, without friction.
///
/// A press is outside the training data where Surrogate::strangeness() exceeds 1, for wide, flat or
/// sharp tools, and for several contacts. Then, and shortly before, finite elements are solved too,
/// and a blend of both results is reported, with a weight that changes within
/// NeuralSettings::switch_time. Elements start without contact, with withdrawn tools; at a first
/// touch their weight is 1 at once. They are not solved while their weight is 0.
class NeuralOrgan final : public TissueModel {
 public:
  /// @throws std::invalid_argument as SurrogateShape.
  NeuralOrgan(NeuralParts parts, const NeuralSettings& neural, const ModelSettings& settings);

  SurfaceState surfaceState(int) const override { return {x_, v_, triangles_, 0}; }
  mesh::CellMesh cells(int organ) const override { return elements_->cells(organ); }
  const TissueStep& step(const std::vector<contact::Obstacle>& obstacles, double dt) override;
  std::vector<std::string> methods(int organ) const override { return elements_->methods(organ); }
  std::vector<std::string> notes() const override;
  void setInterrupt(const solver::Interrupt* interrupt) override {
    elements_->setInterrupt(interrupt);
  }
  void setMeshPace(const MeshPace& pace) override { elements_->setMeshPace(pace); }
  void reset() override;
  void setPositions(int organ, const Points& positions, const Points& velocities) override;
  State state() const override;
  void restore(const State& state) override;

 private:
  std::string kind() const;
  void findPresses(const std::vector<contact::Obstacle>& obstacles);
  double answer();
  double wantedPart(double strangeness) const;
  void drawOut(const std::vector<contact::Obstacle>& obstacles);
  bool stepElements(const std::vector<contact::Obstacle>& obstacles, double dt);
  void approach(double wanted, double strangeness, double dt);
  void report(const std::vector<contact::Obstacle>& obstacles, double dt);
  bool isCalm() const;

  std::unique_ptr<TissueModel> elements_;
  enrichment::Surrogate surrogate_;
  Points X_O_, X_;  // rest positions, organ's frame; equilibrium, world [m]
  Eigen::Matrix3Xi triangles_;
  Mat3 R_WO_;
  double switch_time_, size_;
  bool may_sleep_;
  SurrogateShape learned_shape_;
  PressFinder finder_;
  Points still_;  // zero velocities
  Vec3 gravity_force_;
  double tolerance_;  // of the elements without contact [N]

  // State between cycles:
  double part_ = 0.0;     // weight of the elements [-]
  bool solving_ = false;  // whether elements are solved
  int begun_ = 0;         // cycles to solve elements before their weight grows
  int followed_ = -1;     // obstacle of the surrogate, or -1
  Points x_, v_;

  // State within a cycle:
  std::vector<ToolPress> presses_;       // of the obstacles
  std::vector<contact::Obstacle> ways_;  // for the elements' first cycle
  Vec3 force_ = Vec3::Zero();            // of the surrogate, on the organ [N]
  Eigen::VectorXd coefficients_, work_;
  Points x_begin_;
  TissueStep out_;
};

}  // namespace palpate::tissue
