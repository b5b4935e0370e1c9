// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/fem/elasticity.h"
#include "palpate/tissue/fem/drive.h"
#include "palpate/tissue/fem/fem_tissue.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// A body of finite elements that no tool touches, driven by loads and by held nodes that move, and
/// stepped as an organ of a scene is, by any of methodNames(). Begins at rest in its mesh.
class FemDynamics {
 public:
  /// `elasticity` is that of `settings.element` on `mesh` made of `composition`; others may look at
  /// it between steps. `free`: 3 x n. `pool` may be null and must outlive this.
  /// @throws std::invalid_argument for an unknown method or integrator, or a body that the method
  /// cannot treat.
  FemDynamics(const mesh::TetMesh& mesh, const fem::Composition& composition,
              const fem::FreeMask& free, const FemSettings& settings,
              std::shared_ptr<fem::Elasticity> elasticity, Drive drive, ThreadPool* pool = nullptr);
  ~FemDynamics();
  FemDynamics(const FemDynamics&) = delete;
  FemDynamics& operator=(const FemDynamics&) = delete;

  /// Goes on by `dt` [s]. False: it failed, and the body is where it was.
  bool advance(double dt);
  /// What the last advance() did.
  const TissueStep& report() const;
  const Points& positions() const;      ///< 3 x n [m].
  const Points& supportForces() const;  ///< What the supports exert on the nodes, 3 x n [N].
  double elasticEnergy() const;         ///< Of a viscous body the potential of the last step [J].
  /// What was decided when the method was chosen.
  std::vector<std::string> notes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate::tissue
