// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "palpate/tissue/fem/fem_tissue.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

class FemOrgan;

/// An organ of finite elements, of one body or several, whose cycle begins and ends apart from its
/// bodies' solves: each of these may be solved alone, or together with those of other organs.
class OrganBodies : public TissueModel {
 public:
  /// Its mesh may become another one.
  virtual void beginCycle(const std::vector<contact::Obstacle>& /*obstacles*/, double /*dt*/) {}
  /// Adds the bodies that it consists of now: always as many, in the same order.
  virtual void addBodies(std::vector<FemOrgan*>* bodies) = 0;
  /// All of them have been begun and solved: what they did.
  virtual const TissueStep& endCycle(const std::vector<contact::Obstacle>& obstacles,
                                     double dt) = 0;

  /// Each body alone.
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
