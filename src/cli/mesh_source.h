// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "palpate/mesh/surface_mesh.h"
#include "palpate/mesh/volume_mesher.h"

namespace palpate::cli {

/// What `palpate mesh` is to fill: a file, or an organ of a scene.
struct MeshChoice {
  std::string surface;  ///< A file with its edge length and scale,
  double edge_length = 0.0;
  std::optional<double> scale;
  std::vector<std::string> near;  ///< "X,Y,Z" each: where edges are `finest`
  std::optional<double> finest, radius, growth;
  std::string scene;  ///< or a scene file
  std::string organ;  ///< and an organ's name, which may be left out where there is one only.
};

/// A closed surface in metres, and how it is to be filled.
struct MeshSource {
  mesh::SurfaceMesh surface;
  mesh::MeshingOptions meshing;
  std::vector<std::string> repairs;  ///< One sentence a kind of repair.
};

/// @throws InputError unless the options say one thing and no more.
void checkChoice(const MeshChoice& choice);

/// Of a choice that is right. @throws InputError
MeshSource readMeshSource(const MeshChoice& choice);

}  // namespace palpate::cli
