// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "palpate/analysis/case.h"
#include "palpate/analysis/solve_result.h"
#include "palpate/formats/vtu_writer.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::analysis {

/// Probes of a dynamic case: one row per time step, from t = 0.
struct ProbeHistory {
  std::vector<std::string> columns;  ///< "t", "<probe>.ux" ... or "<probe>.fx" ...
  std::vector<std::vector<double>> rows;
};

/// Result of `palpate solve`; without convergence the last converged state.
struct CaseOutcome {
  SolveResult result;
  bool converged = false;
  mesh::TetMesh mesh;                         ///< In the rest configuration.
  std::vector<formats::VtuArray> point_data;  ///< displacement [m], reaction [N]
  std::vector<formats::VtuArray> cell_data;   ///< cauchy_stress xx yy zz xy yz zx [Pa], jacobian
  ProbeHistory history;                       ///< Empty for a static case.
  std::vector<std::string> notes;             ///< Decisions, for example the method for `auto`.
};

/// Solves a case. Static: loads and displacements grow together over the load steps. Dynamic: from
/// rest, with constant tractions, pressures and gravity; prescribed displacements and rotations
/// grow linearly over the duration. `progress` gets the completed fraction.
/// @throws InputError for an invalid case or mesh: an empty selection, a static body with free
/// rigid motions, a probe outside the mesh.
CaseOutcome solveCase(const Case& problem, int threads,
                      const std::function<void(double)>& progress = {});

}  // namespace palpate::analysis
