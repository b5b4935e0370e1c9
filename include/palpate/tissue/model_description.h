// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "palpate/base/thread_pool.h"
#include "palpate/base/types.h"
#include "palpate/enrichment/deformations.h"
#include "palpate/fem/composition.h"
#include "palpate/fem/elasticity.h"
#include "palpate/fem/supports.h"
#include "palpate/mesh/surface_mesh.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/solver/integrator.h"
#include "palpate/tissue/adapt_settings.h"
#include "palpate/tissue/cloth/cloth_settings.h"
#include "palpate/tissue/enriched/enriched_settings.h"
#include "palpate/tissue/honeycomb/honeycomb_settings.h"
#include "palpate/tissue/hybrid/hybrid_settings.h"
#include "palpate/tissue/model_settings.h"
#include "palpate/tissue/neural/neural_settings.h"
#include "palpate/tissue/sampled/sampling_settings.h"
#include "palpate/tissue/springs/spring_settings.h"
#include "palpate/tissue/surroundings.h"

namespace palpate::tissue {

/// An organ as a scene describes it, in its frame O [m]. Functions compute expensive parts on
/// demand; they are valid during construction of the model.
/// @throws palpate::InputError from the functions, for errors in files.
struct OrganDescription {
  std::string name;
  Pose X_WO = Pose::Identity();  ///< Pose of the organ's frame O in world.

  /// Tetrahedra, read from a file or meshed from the surface, in O.
  std::function<mesh::TetMesh()> tetrahedra;
  /// Closed surface, outward, in O: read and repaired, or the boundary of the tetrahedra.
  std::function<mesh::SurfaceMesh()> surface;
  /// Closed surface, outward, in O, remeshed to edges of organs[].edge_length with sharp features;
  /// or the boundary of the tetrahedra.
  std::function<mesh::SurfaceMesh()> surface_elements;
  /// Surface as in the file, open or closed, in O; empty for an organ without one.
  std::function<mesh::SurfaceMesh()> sheet;
  /// Free components of points X, 3 x n, for models that support only holding; throws for others.
  std::function<fem::FreeMask(const Points& X)> free;
  /// Boundary conditions on a mesh in O, with directions in world.
  std::function<Surroundings(const mesh::TetMesh&)> surroundings;
  /// Materials of the tetrahedra of a mesh in O, with fibre frames in world.
  std::function<fem::Composition(const mesh::TetMesh&)> composition;
  /// A fine surface and its deformations under presses, in O, for model `enriched`.
  std::function<enrichment::DeformationDatabase()> deformations;
  /// Material outside of all regions.
  std::function<material::Solid()> solid;

  std::string element = fem::elementNames().front();  ///< One of fem::elementNames().
  solver::RayleighDamping damping;
  contact::FrictionTable friction;  ///< Friction with obstacles.
  AdaptSettings adapt;              ///< For models with mesh adaptation.
  SpringSettings springs;           ///< For models mass_spring and cloth.
  ClothSettings cloth;              ///< For model cloth.
  SamplingSettings sampling;        ///< For model sampled_elasticity.
  HoneycombSettings honeycomb;      ///< For model honeycomb.
  HybridSettings hybrid;            ///< For model hybrid.
  EnrichedSettings enriched;        ///< For model enriched.
  NeuralSettings neural;            ///< For model neural.
};

/// Arguments for the construction of a tissue model.
struct ModelDescription {
  std::vector<OrganDescription> organs;  ///< One, or all organs of the model: ownsAllOrgans().
  ModelSettings settings;
  ThreadPool* pool = nullptr;  ///< May be null. @pre Outlives the model.
  /// Receives the present task and the fraction done, in [0, 1]; may be empty.
  std::function<void(const std::string& what, double fraction)> progress;
  std::vector<std::string>* warnings = nullptr;  ///< For the user, a line each; may be null.
};

}  // namespace palpate::tissue
