// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/keys/fields.h"
#include "palpate/material/solid_keys.h"
#include "palpate/mesh/selection_keys.h"
#include "palpate/scene/body_config.h"
#include "palpate/solver/damping_keys.h"

namespace palpate::scene {

// All keys of a body's composition, common to scene and case files.
void describe(keys::FieldVisitor& v, MaterialConfig& material);
void describe(keys::FieldVisitor& v, FibreConfig& fibres);
void describe(keys::FieldVisitor& v, RegionConfig& region);
void describe(keys::FieldVisitor& v, BodyConfig& body);

/// Keys of a material without tissue file: law, constants, density, viscoelastic.
void describeLaw(keys::FieldVisitor& v, MaterialConfig& material);

}  // namespace palpate::scene
