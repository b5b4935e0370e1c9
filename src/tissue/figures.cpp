// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/figures.h"

namespace palpate::tissue {

const std::vector<Figure<StepFigures>>& stepFigures() {
  using F = StepFigures;
  using M = Merge;
  // Over sub-steps residual and tolerance are each the largest; `status` says whether each step met
  // its own.
  static const std::vector<Figure<F>> kAll = {
      {"status", "string",
       "converged, inverted, iteration_limit, deadline, line_search_failed, "
       "not_positive_definite or non_finite",
       &F::status, M::kLargest, M::kLargest, M::kLargest},
      {"sweep_stages", "int32", "parts that the tools' motion was cut into", &F::sweep_stages,
       M::kLargest, M::kLargest, M::kLargest},
      {"time_steps", "int32", "time steps in this cycle; > 1 after a failed attempt",
       &F::time_steps, M::kLargest, M::kLargest, M::kLargest},
      {"recovery", "int32",
       "0 none, 1 solved again, 2 in shorter steps, 3 put back to rest, 4 rolled back, 5 frozen",
       &F::recovery, M::kLargest, M::kLargest, M::kLargest},
      {"newton_iterations", "int32", "", &F::newton_iterations, M::kSum, M::kSum, M::kSum},
      {"cg_iterations", "int32", "", &F::linear_iterations, M::kSum, M::kSum, M::kSum},
      {"factor_waits", nullptr,
       "waits for a factor made in the background; depends on machine speed", &F::factor_waits,
       M::kSum, M::kSum, M::kSum},
      {"walk_steps", "int32",
       "triangles of the surface that contact.model prescribed walked on to, with segments",
       &F::walk_steps, M::kSum, M::kSum, M::kSum},
      {"tree_queries", "int32",
       "its searches of the whole surface, where there was nothing to walk from", &F::tree_queries,
       M::kSum, M::kSum, M::kSum},
      {"residual", "float64", "norm of the unbalanced forces [N]", &F::residual, M::kRootOfSquares,
       M::kLargest, M::kLargest},
      {"tolerance", "float64", "what the residual was asked to be below [N]", &F::tolerance,
       M::kRootOfSquares, M::kLargest, M::kLargest},
      {"min_jacobian", "float64", "smallest det F of any element [-]; <= 0: inverted",
       &F::min_jacobian, M::kLeast, M::kLeast, M::kLeast},
      {"kinetic_energy", "float64", "[J]", &F::kinetic_energy, M::kSum, M::kSum, M::kLast},
      {"elastic_energy", "float64", "of viscous organs the potential of the last step [J]",
       &F::elastic_energy, M::kSum, M::kSum, M::kLast},
      {"mesh_error", "float64",
       "estimate of what the tools' forces are too large by because edges are long [N]",
       &F::mesh_error, M::kSum, M::kSum, M::kLast},
      {"finest_edge", "float64",
       "edge length at tools that meshes that adapt are made for, the largest [m]; 0: none adapts",
       &F::finest_edge, M::kLargest, M::kLargest, M::kLast},
      {"cavity_pressure", "float64", "largest pressure in a cavity of an organ, or 0 [Pa]",
       &F::cavity_pressure, M::kLargest, M::kLargest, M::kLast},
      {"tools_inside", "int32",
       "tool shapes that began or got inside an organ: no force until they are clear of it",
       &F::tools_inside, M::kSum, M::kSum, M::kLast},
  };
  return kAll;
}

const char* toString(Merge rule) {
  switch (rule) {
    case Merge::kSum:
      return "sum";
    case Merge::kLargest:
      return "largest";
    case Merge::kLeast:
      return "least";
    case Merge::kRootOfSquares:
      return "root of squares";
    case Merge::kLast:
      return "last";
  }
  return "";
}

void mergeFigures(Over over, const StepFigures& one, StepFigures* all) {
  mergeFigures(stepFigures(), over, one, all);
  all->phases += one.phases;
}

}  // namespace palpate::tissue
