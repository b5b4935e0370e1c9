// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "palpate/tissue/fem/fem_tissue.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

class FemOrgan;

/// A finite element organ of one or several bodies. Cycles begin and end separately from the
/// solves, so that bodies can be solved alone or in groups with other organs'.
class OrganBodies : public TissueModel {
 public:
  /// Begins a cycle; the mesh may change.
  virtual void beginCycle(const std::vector<contact::Obstacle>& /*obstacles*/, double /*dt*/) {}
  /// Adds the present bodies, always the same number in the same order.
  virtual void addBodies(std::vector<FemOrgan*>* bodies) = 0;
  /// Ends the cycle and returns its result.
  /// @pre All bodies are solved.
  virtual const TissueStep& endCycle(const std::vector<contact::Obstacle>& obstacles,
                                     double dt) = 0;

  /// Steps each body alone.
  const TissueStep& step(const std::vector<contact::Obstacle>& obstacles, double dt) override;

 private:
  std::vector<FemOrgan*> stepped_;
};

/// See makeIslands().
std::unique_ptr<OrganBodies> makeOrganBodies(const mesh::TetMesh& mesh,
                                             const fem::Composition& composition,
                                             const Surroundings& surroundings,
                                             const FemSettings& settings, ThreadPool* pool);

}  // namespace palpate::tissue
