// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/types.h"
#include "palpate/contact/response.h"
#include "palpate/contact/surface_samples.h"
#include "palpate/solver/step_settings.h"
#include "palpate/tissue/interaction.h"
#include "palpate/tissue/skip_switches.h"
#include "palpate/tissue/touching_organs.h"

namespace palpate::tissue {

/// What a scene says to all its tissue models; each heeds what it has a use for. What is a key of
/// scenes has its default in the struct that scenes hold as well.
struct ModelSettings : solver::StepSettings {
  Vec3 gravity = Vec3::Zero();  ///< [m/s^2], world
  contact::ResponseSettings contact;
  std::vector<contact::ResponseEntry> responses = contact::responses();  ///< That it may name.
  TouchingOrgans touching;  ///< For models that own several organs.
  std::vector<InteractionEntry> interactions = tissue::interactions();  ///< That act between them.
  contact::SampleSpacing sample_spacing;
  bool needles = false;  ///< Some instrument goes into tissue.
  SkipSwitches skip;
};

}  // namespace palpate::tissue
