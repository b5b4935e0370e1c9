// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/contact/response.h"
#include "palpate/tissue/skip_switches.h"

namespace palpate::tissue {

/// What a scene says to all its tissue models; each heeds what it has a use for.
struct ModelSettings {
  std::string method = "implicit_pcg";  ///< One of methodNames(), of finite elements.
  std::string integrator = "backward_euler";
  double step = 0.01;           ///< Usual length of a cycle [s].
  Vec3 gravity = Vec3::Zero();  ///< [m/s^2], world
  contact::ResponseSettings contact;
  std::vector<contact::ResponseEntry> responses = contact::responses();  ///< That it may name.
  double sample_spacing = 0.0;         ///< [m], see contact::sampleSurface()
  double tolerance = 1.0e-4;           ///< Of the residual, relative to the forces.
  double position_tolerance = 1.0e-5;  ///< Residuals that move no node farther are let be [m].
  int max_newton_iterations = 20;
  double linear_tolerance = 1.0e-1;
  int max_linear_iterations = 500;
  SkipSwitches skip;
};

}  // namespace palpate::tissue
