// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/static_solver.h"

#include <algorithm>

#include "palpate/solver/cholmod_solver.h"

namespace palpate::solver {
namespace {

constexpr double kSmallestCut = 1.0 / 256.0;

// Scale of the residual: norm of the forces of loads and supports on the body at x.
double forceScale(const Potential& potential, const Points& x, Points* g) {
  potential.gradient(x, g);
  const double reactions = (g->array() * (1.0 - potential.free.array())).matrix().norm();
  potential.elasticity->gradient(x, g);
  const double elastic = g->norm();  // equals the loads at equilibrium
  return std::max(reactions, elastic);
}

}  // namespace

StaticReport solveStatic(const Potential& potential, const std::function<Points(double)>& setLoad,
                         const StaticSettings& settings, Points* x,
                         const std::function<void(double)>& progress) {
  StaticReport report;
  Newton newton(potential.elasticity->makeMatrix(), std::make_unique<CholmodSolver>());
  const fem::FreeMask held = 1.0 - potential.free.array();
  const double step = 1.0 / std::max(settings.load_steps, 1);
  double cut = 1.0;
  Points g;
  while (report.load_factor < 1.0) {
    const double next = std::min(1.0, report.load_factor + cut * step);
    const double target = next > 1.0 - 1e-12 ? 1.0 : next;
    Points trial = *x;
    const Points move = (setLoad(target) - trial).cwiseProduct(held);
    NewtonReport solved;
    solved.status = newton.predict(potential, move, &trial);
    if (solved.status == SolveStatus::kConverged) {
      NewtonSettings newton_settings;
      newton_settings.max_iterations = settings.max_newton_iterations;
      const double scale = forceScale(potential, trial, &g);
      newton_settings.tolerance = std::max(settings.tolerance * scale, newton.roundoffForce(trial));
      solved = newton.minimize(potential, newton_settings, &trial);
      report.newton_iterations += solved.iterations + 1;
      if (solved.status == SolveStatus::kConverged) {
        // The scale at the guess may far exceed that at equilibrium, so it is evaluated again.
        const double final_scale = forceScale(potential, trial, &g);
        newton_settings.tolerance =
            std::max(settings.tolerance * final_scale, newton.roundoffForce(trial));
        solved = newton.minimize(potential, newton_settings, &trial);
        report.newton_iterations += solved.iterations;
        report.residual = final_scale > 0.0 ? solved.residual / final_scale : 0.0;
      }
    }
    report.status = solved.status;
    if (solved.status == SolveStatus::kConverged) {
      *x = trial;
      report.load_factor = target;
      ++report.load_steps;
      cut = std::min(1.0, 2.0 * cut);
      if (progress) progress(target);
    } else if (cut > kSmallestCut) {
      cut *= 0.5;
    } else {
      setLoad(report.load_factor);
      return report;
    }
  }
  return report;
}

}  // namespace palpate::solver
