// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fine_surface.h"
#include "learned_detail.h"
#include "tissue/organ/fem_organ.h"

namespace palpate::tissue {

/// A finite element body with a fine surface for display and contact. The learned detail follows
/// the result of the last cycle with time constant `time`, so that it does not jump.
class EnrichedOrgan final : public OrganBodies {
 public:
  /// `body` feels contact at the samples of `fine`, in equilibrium. `time` [s].
  EnrichedOrgan(std::unique_ptr<FemOrgan> body, FineSurface fine, LearnedDetail learned,
                double time);

  SurfaceState surfaceState(int) const override { return {x_, v_, triangles_, 0}; }
  mesh::CellMesh cells(int) const override;
  std::vector<std::string> methods(int) const override { return body_->methods(0); }
  std::vector<std::string> notes() const override { return body_->notes(); }
  void setInterrupt(const solver::Interrupt* interrupt) override { body_->setInterrupt(interrupt); }
  void addBodies(std::vector<FemOrgan*>* bodies) override { bodies->push_back(body_.get()); }
  const TissueStep& endCycle(const std::vector<contact::Obstacle>&, double dt) override;

  void reset() override;
  /// Positions and velocities: the body's nodes, then the fine points, which define the detail.
  void setPositions(int, const Points& positions, const Points& velocities) override;
  State state() const override;
  void restore(const State& state) override;

 private:
  std::string kind() const;
  bool follow(double dt);
  void show();

  std::unique_ptr<FemOrgan> body_;
  FineSurface fine_;
  LearnedDetail learned_;
  double time_, still_;  // time constant [s]; change of detail that counts as zero [m]
  Points equilibrium_;   // of the body's nodes
  Eigen::Matrix3Xi triangles_;
  Points detail_, rate_;              // detail of the fine points [m] and its rate [m/s]
  Points target_, u_, offsets_, on_;  // buffers
  Points x_, v_;
};

}  // namespace palpate::tissue
