// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/keys/fields.h"
#include "palpate/material/solid_keys.h"
#include "palpate/mesh/selection_keys.h"
#include "palpate/scene/body_config.h"
#include "palpate/solver/damping_keys.h"

namespace palpate::scene {

// Every key of what a body is made of, the same in scene and case files.
void describe(keys::FieldVisitor& v, MaterialConfig& material);
void describe(keys::FieldVisitor& v, FibreConfig& fibres);
void describe(keys::FieldVisitor& v, RegionConfig& region);
void describe(keys::FieldVisitor& v, BodyConfig& body);

/// The keys of a material that is written out: law, constants, density, viscoelastic.
void describeLaw(keys::FieldVisitor& v, MaterialConfig& material);

}  // namespace palpate::scene
