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

/// An organ as a scene describes it, in its own frame O and in metres. What is dear to make is made
/// when it is asked for, so that a model gets what it needs and no more. The functions live as long
/// as the model is being made, and throw palpate::InputError for what is wrong in the files.
struct OrganDescription {
  std::string name;
  Pose X_WO = Pose::Identity();  ///< Where it is in the world.

  /// Its tetrahedra: read, or filled into its surface.
  std::function<mesh::TetMesh()> tetrahedra;
  /// Its closed surface, outward: read and repaired, or the boundary of its tetrahedra.
  std::function<mesh::SurfaceMesh()> surface;
  /// Its closed surface, outward, in triangles with edges of about organs[].edge_length and along
  /// sharp ones; of tetrahedra, their boundary.
  std::function<mesh::SurfaceMesh()> surface_elements;
  /// Its surface as the file has it, open or closed, of an organ that has one; may be empty.
  std::function<mesh::SurfaceMesh()> sheet;
  /// What the supports leave free of points X, 3 x n, for models that know no other surroundings:
  /// it throws where the organ has some.
  std::function<fem::FreeMask(const Points& X)> free;
  /// What surrounds the organ, on a mesh in O; directions are in the world.
  std::function<Surroundings(const mesh::TetMesh&)> surroundings;
  /// What the tetrahedra of a mesh in O are made of, with frames in the world.
  std::function<fem::Composition(const mesh::TetMesh&)> composition;
  /// A fine surface and how presses deform it, in O, as `enriched` asks for.
  std::function<enrichment::DeformationDatabase()> deformations;
  /// What the organ is made of where no region says otherwise.
  std::function<material::Solid()> solid;

  std::string element =
      fem::elementNames().front();  ///< One of fem::elementNames(), for models of finite elements.
  solver::RayleighDamping damping;
  contact::FrictionTable friction;  ///< With what it touches.
  AdaptSettings adapt;              ///< For models whose mesh can change.
  SpringSettings springs;           ///< For models mass_spring and cloth.
  ClothSettings cloth;              ///< For model cloth.
  SamplingSettings sampling;        ///< For model sampled_elasticity.
  HoneycombSettings honeycomb;      ///< For model honeycomb.
  HybridSettings hybrid;            ///< For model hybrid.
  EnrichedSettings enriched;        ///< For model enriched.
  NeuralSettings neural;            ///< For model neural.
};

/// What the maker of a tissue model gets.
struct ModelDescription {
  std::vector<OrganDescription> organs;  ///< One, unless the model owns all of its name together.
  ModelSettings settings;
  ThreadPool* pool = nullptr;  ///< May be null; outlives the model.
  /// What is being done, and a part in [0, 1]; may be empty.
  std::function<void(const std::string& what, double fraction)> progress;
  std::vector<std::string>* warnings = nullptr;  ///< For the user, a line each; may be null.
};

}  // namespace palpate::tissue
