// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fem_body.h"
#include "palpate/mesh/mesh_change.h"
#include "palpate/tissue/fem/fem_tissue.h"
#include "step_method.h"
#include "tissue/touch/rest.h"

namespace palpate::tissue {

/// A body of finite elements that is stepped by one method, sleeps where nothing happens, and
/// reports: makeFemTissue().
class FemOrgan final : public TissueModel {
 public:
  /// At rest in its mesh, as yet without gravity.
  FemOrgan(const mesh::TetMesh& mesh, const fem::Composition& composition,
           const fem::FreeMask& free, const FemSettings& settings, ThreadPool* pool,
           const Eigen::Matrix3Xi& surface = {});

  /// Begins at the equilibrium under gravity, which reset() goes back to from now on.
  /// @throws as makeFemTissue()
  void settle();
  /// Goes on where `old` is, which is the same body on another mesh, of which this one's came by
  /// `change`: positions, velocities, and all memory that has a place. What reset() goes back to
  /// stays.
  void goOnFrom(const FemOrgan& old, const mesh::MeshChange& change);
  /// Whether it can: no element would be turned inside out, or lose half of the room that the least
  /// one of `old` has left, and the energy is finite.
  bool canGoOnFrom(const FemOrgan& old, const mesh::MeshChange& change) const;

  Shape shape(int) const override { return {body_.x, body_.v, body_.triangles, 0}; }
  mesh::CellMesh cells(int) const override { return mesh::cellsOf(body_.mesh); }
  std::vector<std::string> methods() const override { return {body_.method}; }
  std::vector<std::string> notes() const override;
  void setInterrupt(const solver::Interrupt* interrupt) override { body_.interrupt = interrupt; }
  void reset() override;
  void place(int, const Points& positions, const Points& velocities) override;
  State state() const override;
  void restore(const State& state) override;
  const TissueStep& step(const std::vector<contact::Obstacle>& obstacles, double dt) override;

 private:
  bool cameToRest();
  void stop();
  void reportState();

  FemBody body_;
  std::unique_ptr<StepMethod> method_;
  Rest rest_;
  Points settled_;
  TissueStep out_;
};

}  // namespace palpate::tissue
