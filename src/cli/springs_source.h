// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "palpate/springs/constraint_family.h"
#include "palpate/springs/sheet_topology.h"
#include "palpate/springs/spring_network.h"

namespace palpate::cli {

/// What `palpate springs` is to give springs: a file, or a regular mesh.
struct SpringsChoice {
  std::string mesh;  ///< A file of triangles or tetrahedra,
  std::optional<double> scale;
  std::optional<std::string> regular;  ///< or line, squares, triangles, cubes,
  std::string cells;                   ///< so many: "N", "N,N" or "N,N,N",
  std::optional<double> spacing;       ///< so far apart [m].
  std::optional<std::string> diagonals;
  bool printed = false;

  double young_modulus = 0.0;  ///< [Pa]
  double density = 0.0;        ///< [kg/m^3]
  std::optional<double> poisson_ratio, thickness, width;
  std::optional<double> step;  ///< Explicit step that bounds stiffnesses [s].
  bool match_mean = false;
};

/// Springs, and what was found on the way.
struct MadeSprings {
  springs::SpringNetwork network;
  std::optional<springs::SheetCounts> counts;
  std::vector<std::pair<std::string, std::vector<springs::ConstraintFamily>>> residuals;
  int slack = 0, bounded = 0;  ///< Springs at a stiffness of 0, and at the bound of the step.
};

/// @throws InputError
MadeSprings makeSprings(const SpringsChoice& choice);

}  // namespace palpate::cli
