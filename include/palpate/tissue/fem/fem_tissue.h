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
  int max_time_steps = 8;       ///< Most time steps of a cycle after failed attempts: 1, 2, 4 ...
  bool only_converged = false;  ///< Whether a step at its iteration limit has failed.
  bool lasting = true;          ///< False: mesh adaptation will soon replace the body.
  double thickness = 0.0;  ///< Of a sheet [m]; 0: the surface encloses a body. See ToolContact.
};

/// State::kind of such a body: method, integrator, element, contact response, number of points.
std::string stateKind(const FemSettings& settings, Eigen::Index num_points);

/// Makes a model of nonlinear finite elements, stepped by one of methodNames(). Long tool paths are
/// cut into stages short against the thinnest tool, each solved before the next, so that no tool
/// passes through the tissue (sweep.h).
///
/// `mesh`: world, for the element (fem::meshFor()); `surroundings`: boundary conditions; `pool`:
/// may be null. The initial state is the equilibrium under gravity.
/// @pre `pool` outlives the model.
/// @throws std::invalid_argument for an unknown element, method or response, an invalid mesh, or
/// supports that do not hold the body under gravity; std::runtime_error if there is no equilibrium.
std::unique_ptr<TissueModel> makeFemTissue(const mesh::TetMesh& mesh,
                                           const fem::Composition& composition,
                                           const Surroundings& surroundings,
                                           const FemSettings& settings, ThreadPool* pool = nullptr);

}  // namespace palpate::tissue
