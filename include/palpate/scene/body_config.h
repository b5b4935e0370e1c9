// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/material/constants.h"
#include "palpate/material/solid.h"
#include "palpate/mesh/selection.h"

namespace palpate::scene {

// Composition of a body as plain data, for organs of scenes and bodies of cases. All defaults are
// member initialisers.

/// A tissue file (tissue_file.h), or a law with its constants.
struct MaterialConfig {
  std::string file;  ///< Relative to the scene's or case's folder.
  std::string law = "stable_neo_hookean";
  double density = 1000.0;  ///< [kg/m^3]
  material::Constants constants;
  std::vector<material::PronyTerm> viscoelastic;
};

/// Fibre directions in the body's frame: uniform, or cell data of the mesh file.
struct FibreConfig {
  std::optional<Vec3> direction;  ///< Of any nonzero length.
  std::optional<Vec3> sheet;      ///< Not parallel to the fibre.
  std::string field;              ///< Name of an array of three components per tetrahedron.
  std::string sheet_field;
};

/// Tetrahedra of another material than the rest of the body.
struct RegionConfig {
  std::string name;
  mesh::TetRegion select;  ///< In the body's frame, after scaling.
  std::optional<MaterialConfig> material;
  std::optional<FibreConfig> fibres;
};

struct BodyConfig {
  MaterialConfig material;
  std::optional<FibreConfig> fibres;
  std::vector<RegionConfig> regions;  ///< The last of overlapping regions applies.
};

}  // namespace palpate::scene
