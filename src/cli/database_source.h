// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "palpate/enrichment/press_plan.h"
#include "palpate/enrichment/pressed_body.h"
#include "palpate/mesh/volume_mesher.h"

namespace palpate::cli {

/// What `palpate database` is to press.
struct DatabaseChoice {
  std::string scene, organ;
  int triangles = 276;                ///< Of the coarse surface.
  int splits = 2;                     ///< Of each of them, to the fine one.
  std::optional<double> edge_length;  ///< Of tetrahedra [m]; else the fine surface's mean.
  std::optional<double> patch;        ///< [m]; else the coarse surface's mean edge.
  enrichment::PressPlan plan;
};

/// An organ of a scene with its surfaces, in the organ's frame.
struct DatabaseSource {
  mesh::SurfaceMesh coarse, fine;
  std::vector<int> contacts;  ///< Coarse points that nothing holds.
  double edge_length = 0.0, patch = 0.0;
  std::string made_by;  ///< All that decides a sample but the surfaces.

  std::string scene, key;  ///< The file, and the organ's place in it.
  std::string element;
  mesh::TetMesh mesh;
  fem::Composition composition;
  fem::FreeMask free;

  std::unique_ptr<enrichment::PressedBody> makeBody() const;
};

/// `progress`: of meshing. @throws InputError
DatabaseSource readDatabaseSource(const DatabaseChoice& choice,
                                  const mesh::MeshingProgress& progress);

}  // namespace palpate::cli
