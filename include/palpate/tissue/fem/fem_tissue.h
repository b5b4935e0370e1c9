// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/base/thread_pool.h"
#include "palpate/fem/composition.h"
#include "palpate/fem/elasticity.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/tissue/method_facts.h"
#include "palpate/tissue/model_settings.h"
#include "palpate/tissue/surroundings.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

struct FemSettings : ModelSettings {
  FemSettings() = default;
  explicit FemSettings(const ModelSettings& settings) : ModelSettings(settings) {}

  std::string element = fem::elementNames().front();
  double mass_damping = 0.0;       ///< [1/s]
  double stiffness_damping = 0.0;  ///< [s]
  int max_time_steps = 8;          ///< That a cycle is cut into where longer ones fail: 1, 2, 4 ...
  bool only_converged = false;     ///< A step that ran out of iterations counts as failed.
  bool lasting = true;             ///< False: it soon has another mesh.
  double thickness = 0.0;  ///< Of a sheet [m]; 0: the surface encloses a body. See ToolContact.
};

/// What the state of such a body says it is: method, integrator, element,
/// response to touches, and how many points.
std::string stateKind(const FemSettings& settings, Eigen::Index num_points);

/// Nonlinear finite elements, stepped by one of several methods. When tools move far within a
/// cycle, the motion is swept in stages short against the thinnest tool, each solved before the
/// next, so that no tool passes through (sweep.h).
///
/// `mesh` is in world and as the element needs it (fem::meshFor()), `surroundings` what holds
/// it; a mask alone will do. `pool` may be null and must outlive the model. Starts from the
/// equilibrium under gravity.
/// @throws std::invalid_argument for an unknown element, method or response, a bad mesh, or a body
/// that gravity would drag away because the supports do not hold it; std::runtime_error if there is
/// no equilibrium.
std::unique_ptr<TissueModel> makeFemTissue(const mesh::TetMesh& mesh,
                                           const fem::Composition& composition,
                                           const Surroundings& surroundings,
                                           const FemSettings& settings, ThreadPool* pool = nullptr);

}  // namespace palpate::tissue
