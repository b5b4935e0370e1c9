// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace palpate::solver {

/// How steps in time are solved, and how well. These initialisers are the only defaults: scenes and
/// tissue models derive from this struct, cases and what solves a step take their own from it.
struct StepSettings {
  std::string method = "implicit_pcg";  ///< The first of tissue::methodNames().
  std::string integrator = "backward_euler";
  double step = 0.01;                  ///< Usual length of a step [s]; of a scene the longest.
  double tolerance = 1.0e-4;           ///< Newton: residual over the forces' scale.
  double position_tolerance = 1.0e-5;  ///< Residuals that move no node farther are let be [m].
  int max_newton_iterations = 20;
  double linear_tolerance = 1.0e-1;  ///< Of the linear solver, over its residual at the start.
  int max_linear_iterations = 500;
};

}  // namespace palpate::solver
