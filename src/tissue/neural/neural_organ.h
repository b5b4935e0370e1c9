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

/// What an organ of model neural is made of.
struct NeuralParts {
  std::unique_ptr<TissueModel> elements;  ///< The same organ of finite elements, linear ones.
  enrichment::Surrogate surrogate;
  mesh::CellMesh body;  ///< At rest in the organ's frame [m].
  fem::FreeMask free;   ///< Of its points.
  Pose X_WO;
};

/// An organ that answers presses as it has learned, and by finite elements what it has not.
///
/// The tool that touches first is looked up where it is deepest in the organ's surface in its
/// initial equilibrium, with the displacement that brings that place onto the tool. The surrogate's
/// force is of a pressure on a patch of radius p; where a ball of radius R is pressed d deep, it is
/// taken times
///
///     s = 32 sqrt(R d) / (9 pi p),
///
/// what Hertz's force of the ball is over that of the patch's pressure, both on a half space that
/// is displaced as far in the middle [Johnson 1985, secs. 3.4, 4.2]. It is normal to the tool:
/// there is no friction.
///
/// A press is unlike what was learned where Surrogate::strangeness() is above 1, where the tool is
/// wide, flat or of an edge, and where several touch. Then, and some way before, the elements are
/// solved in the same cycles, and a part of their force and shape is told that goes from 0 to 1 and
/// back no faster than NeuralSettings::switch_time. They begin where nothing touches, with the
/// tools drawn out, and at a first touch are told at once; they are not solved while none of them
/// is told.
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
  Points X_O_, X_;  // at rest in the organ's frame, in equilibrium in the world
  Eigen::Matrix3Xi triangles_;
  Mat3 R_WO_;
  double switch_time_, size_;
  bool may_sleep_;
  SurrogateShape learned_shape_;
  PressFinder finder_;
  Points still_;  // velocities of none
  Vec3 gravity_force_;
  double tolerance_;  // of the elements, where nothing touches [N]

  // From one cycle to the next:
  double part_ = 0.0;     // of the elements in what is told
  bool solving_ = false;  // the elements
  int begun_ = 0;         // cycles that they are solved before any of them is told, still to come
  int followed_ = -1;     // the obstacle that is looked up, or -1
  Points x_, v_;

  // Within one:
  std::vector<ToolPress> presses_;       // of the obstacles
  std::vector<contact::Obstacle> ways_;  // of the elements' first cycle
  Vec3 force_ = Vec3::Zero();            // on the organ, as learned [N]
  Eigen::VectorXd coefficients_, work_;
  Points x_begin_;
  TissueStep out_;
};

}  // namespace palpate::tissue
