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

/// Dynamics of a finite element body without tools, under loads and prescribed motion. Steps as an
/// organ of a scene, by any of methodNames(), from the rest configuration with zero velocity.
class FemDynamics {
 public:
  /// `elasticity`: of `settings.element`, `mesh` and `composition`; `free`: 3 x n; `pool`: may be
  /// null.
  /// @pre `pool` outlives this.
  /// @throws std::invalid_argument for an unknown method or integrator, or a body that the method
  /// does not support.
  FemDynamics(const mesh::TetMesh& mesh, const fem::Composition& composition,
              const fem::FreeMask& free, const FemSettings& settings,
              std::shared_ptr<fem::Elasticity> elasticity, Drive drive, ThreadPool* pool = nullptr);
  ~FemDynamics();
  FemDynamics(const FemDynamics&) = delete;
  FemDynamics& operator=(const FemDynamics&) = delete;

  /// Simulates `dt` [s]. Returns false on failure; the body is then unchanged.
  bool advance(double dt);
  /// Result of the last advance().
  const TissueStep& report() const;
  const Points& positions() const;      ///< 3 x n [m].
  const Points& supportForces() const;  ///< Support forces on the nodes, 3 x n [N].
  /// Elastic energy [J]; of a viscous body the potential of the last step.
  double elasticEnergy() const;
  /// Decisions at the choice of the method, a line each.
  std::vector<std::string> notes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate::tissue
