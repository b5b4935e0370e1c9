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

/// What it took to get through a cycle, each worse than the one before. StepFigures::recovery.
enum class Recovery {
  kNone,
  kSolvedAgain,   ///< With a guard against elements that are turned inside out.
  kShorterSteps,  ///< A step failed; shorter ones, or implicit ones in the place of explicit ones.
  kPutBack,       ///< Where no force or step leads away: at rest again.
  kRolledBack,    ///< All failed; where it was before the cycle.
  kFrozen         ///< It failed in many cycles, and was not tried.
};

/// What a cycle did and how well: of a part of an organ, an organ, a scene, or of several cycles
/// between two inputs. What each means stands in stepFigures().
struct StepFigures {
  solver::SolveStatus status = solver::SolveStatus::kConverged;
  int sweep_stages = 1;
  int time_steps = 1;
  int recovery = 0;  ///< A Recovery.
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
  double cavity_pressure = 0.0;  ///< [Pa]
  int tools_inside = 0;
  PhaseTimes phases;  ///< Wall time; the one part that differs between equal runs.

  void recover(Recovery by) { recovery = std::max(recovery, static_cast<int>(by)); }
  bool ok() const { return status == solver::SolveStatus::kConverged; }
};

/// What several figures are as one.
enum class Merge { kSum, kLargest, kLeast, kRootOfSquares, kLast };

/// As in tables of the documentation: "root of squares".
const char* toString(Merge rule);

/// Of what figures are merged.
enum class Over {
  kParts,    ///< Unconnected parts of an organ.
  kOrgans,   ///< Organs of a scene.
  kSubSteps  ///< Steps that a recorded input was cut into, in their order.
};

/// A figure of a step: where it stands in Step, what it is called, and what several are as one.
template <class Step>
struct Figure {
  const char* name;     ///< Of the field of StepReport.msg.
  const char* message;  ///< Type of that field; null where the figure is in no message.
  const char* doc;      ///< With its unit, as in StepReport.msg.
  std::variant<int Step::*, double Step::*, solver::SolveStatus Step::*, std::uint64_t Step::*>
      value;
  Merge over_parts, over_organs, over_sub_steps;

  Merge rule(Over over) const {
    return over == Over::kParts ? over_parts : over == Over::kOrgans ? over_organs : over_sub_steps;
  }
};

/// Every figure of StepFigures but the phases, which are always added up. To add one: a member, a
/// line in figures.cpp, a field of StepReport.msg and its row in docs/architecture.md.
const std::vector<Figure<StepFigures>>& stepFigures();

/// One value of two; where the order counts, `later` is the later one.
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
