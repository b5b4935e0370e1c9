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

/// Settings of a scene for all its tissue models; each uses a part. Defaults of keys are those of
/// the structs that scenes hold.
struct ModelSettings : solver::StepSettings {
  Vec3 gravity = Vec3::Zero();  ///< [m/s^2], world
  contact::ResponseSettings contact;
  std::vector<contact::ResponseEntry> responses = contact::responses();  ///< For contact.model.
  TouchingOrgans touching;  ///< For models that own several organs.
  std::vector<InteractionEntry> interactions = tissue::interactions();  ///< Of these organs.
  contact::SampleSpacing sample_spacing;
  bool needles = false;  ///< Whether an instrument is a needle.
  SkipSwitches skip;
};

}  // namespace palpate::tissue
