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

/// Probes of a dynamic case over time: a row a time step, beginning with t = 0.
struct ProbeHistory {
  std::vector<std::string> columns;  ///< "t", "<probe>.ux" ... or "<probe>.fx" ...
  std::vector<std::vector<double>> rows;
};

/// What `palpate solve` found; also where it did not converge, then the last good state.
struct CaseOutcome {
  SolveResult result;
  bool converged = false;
  mesh::TetMesh mesh;                         ///< The reference shape.
  std::vector<formats::VtuArray> point_data;  ///< displacement [m], reaction [N]
  std::vector<formats::VtuArray> cell_data;   ///< cauchy_stress xx yy zz xy yz zx [Pa], jacobian
  ProbeHistory history;                       ///< Empty for a static case.
  std::vector<std::string> notes;             ///< What was decided: the method for `auto`.
};

/// Solves a case. Static: loads and displacements grow together over the load steps. Dynamic: from
/// rest; tractions, pressures and gravity act in full from the start, prescribed displacements and
/// rotations grow linearly over the duration. `progress` is told the fraction done.
/// @throws InputError for what is wrong with the case or its mesh: no node or no face selected, a
/// static body that its supports do not hold, a probe outside the mesh.
CaseOutcome solveCase(const Case& problem, int threads,
                      const std::function<void(double)>& progress = {});

}  // namespace palpate::analysis
