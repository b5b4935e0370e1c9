// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <variant>
#include <vector>

#include "palpate/base/phase_times.h"
#include "palpate/solver/status.h"

namespace palpate::tissue {

/// Recovery after failures in a cycle, in ascending severity: StepFigures::recovery.
enum class Recovery {
  kNone,
  kSolvedAgain,   ///< Solved again with a barrier against inverted elements.
  kShorterSteps,  ///< Solved in shorter steps, or by implicit instead of explicit ones.
  kPutBack,       ///< Reset to the equilibrium: no step leads out of the state.
  kRolledBack,    ///< Rolled back to the cycle's begin: all attempts failed.
  kFrozen         ///< Skipped after failures in many cycles.
};

/// Figures of a cycle: of an island, an organ, a scene, or several cycles between two inputs.
/// stepFigures() documents each.
struct StepFigures {
  solver::SolveStatus status = solver::SolveStatus::kConverged;
  int sweep_stages = 1;
  int time_steps = 1;
  int recovery = 0;  ///< A value of Recovery.
  int newton_iterations = 0;
  int linear_iterations = 0;
  int factor_waits = 0;
  int walk_steps = 0;
  int tree_queries = 0;
  double residual = 0.0;   ///< [N]
  double tolerance = 0.0;  ///< [N]
  double min_jacobian = 1.0;
  double kinetic_energy = 0.0;   ///< [J]
  double elastic_energy = 0.0;   ///< [J]
  double mesh_error = 0.0;       ///< [N]
  double finest_edge = 0.0;      ///< [m]
  double cavity_pressure = 0.0;  ///< [Pa]
  int tools_inside = 0;
  PhaseTimes phases;  ///< Wall time; all other figures are equal in equal runs.

  void recover(Recovery by) { recovery = std::max(recovery, static_cast<int>(by)); }
  bool ok() const { return status == solver::SolveStatus::kConverged; }
};

/// Rule that merges several values of a figure into one.
enum class Merge { kSum, kLargest, kLeast, kRootOfSquares, kLast };

/// Name of the rule in tables of the documentation, such as "root of squares".
const char* toString(Merge rule);

/// Sets over which figures are merged.
enum class Over {
  kParts,    ///< Islands of an organ.
  kOrgans,   ///< Organs of a scene.
  kSubSteps  ///< Sub-steps of a recorded input, in their order.
};

/// A figure of a step: member of Step, name, documentation and rules of merging.
template <class Step>
struct Figure {
  const char* name;     ///< Name of the field of StepReport.msg.
  const char* message;  ///< Type of that field; null where no message has the figure.
  const char* doc;      ///< Meaning with unit, as in StepReport.msg.
  std::variant<int Step::*, double Step::*, solver::SolveStatus Step::*, std::uint64_t Step::*>
      value;
  Merge over_parts, over_organs, over_sub_steps;

  Merge rule(Over over) const {
    return over == Over::kParts ? over_parts : over == Over::kOrgans ? over_organs : over_sub_steps;
  }
};

/// All figures of StepFigures except the phases, which are summed. To add one: a member, a
/// line in figures.cpp, a field of StepReport.msg and its row in docs/architecture.md.
const std::vector<Figure<StepFigures>>& stepFigures();

/// Merges two values; kLast takes `later`.
template <class Value>
Value merged(Merge rule, Value earlier, Value later) {
  switch (rule) {
    case Merge::kSum:
      if constexpr (std::is_enum_v<Value>)
        break;
      else
        return earlier + later;
    case Merge::kLargest:
      return std::max(earlier, later);
    case Merge::kLeast:
      return std::min(earlier, later);
    case Merge::kRootOfSquares:
      if constexpr (std::is_floating_point_v<Value>) return std::hypot(earlier, later);
      break;
    case Merge::kLast:
      break;
  }
  return later;
}

/// Merges the figures of the table from `one` into `all`. Of sub-steps `one` is the later.
template <class Step>
void mergeFigures(const std::vector<Figure<Step>>& table, Over over, const Step& one, Step* all) {
  for (const Figure<Step>& figure : table) {
    std::visit(
        [&](auto member) { all->*member = merged(figure.rule(over), all->*member, one.*member); },
        figure.value);
  }
}

/// Merges all figures of `one` into `all`, the phases as well.
void mergeFigures(Over over, const StepFigures& one, StepFigures* all);

}  // namespace palpate::tissue
