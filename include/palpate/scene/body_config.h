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

// What a body is made of, as plain data; organs of scenes and bodies of cases share it. Member
// initialisers are the only defaults.

/// Either a tissue file (tissue_file.h) or a law with its constants.
struct MaterialConfig {
  std::string file;  ///< Relative paths start from the scene's or case's folder.
  std::string law = "stable_neo_hookean";
  double density = 1000.0;  ///< [kg/m^3]
  material::Constants constants;
  std::vector<material::PronyTerm> viscoelastic;
};

/// Directions in the body's own frame: the same everywhere, or cell data of the mesh file.
struct FibreConfig {
  std::optional<Vec3> direction;  ///< Of any length but zero.
  std::optional<Vec3> sheet;      ///< Not parallel to the fibre.
  std::string field;              ///< Array of three components a tetrahedron.
  std::string sheet_field;
};

/// Tetrahedra that differ from the rest of the body.
struct RegionConfig {
  std::string name;
  mesh::TetRegion select;  ///< In the body's own frame, after scaling.
  std::optional<MaterialConfig> material;
  std::optional<FibreConfig> fibres;
};

struct BodyConfig {
  MaterialConfig material;
  std::optional<FibreConfig> fibres;
  std::vector<RegionConfig> regions;  ///< Where they overlap, the later one holds.
};

}  // namespace palpate::scene
