// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/keys/fields.h"
#include "palpate/scene/body_fields.h"
#include "palpate/scene/scene.h"

namespace palpate::scene {

// All keys of a scene file.
void describe(keys::FieldVisitor& v, Scene& scene);
void describe(keys::FieldVisitor& v, OrganConfig& organ);
void describe(keys::FieldVisitor& v, ProxyConfig& proxy);
void describe(keys::FieldVisitor& v, DeviceConfig& device);
void describe(keys::FieldVisitor& v, LimitsConfig& limits);
void describe(keys::FieldVisitor& v, PoseConfig& pose);
void describe(keys::FieldVisitor& v, InstrumentConfig& instrument);
void describe(keys::FieldVisitor& v, MeshShapeConfig& shape);
void describe(keys::FieldVisitor& v, AnatomyConfig& anatomy);
void describe(keys::FieldVisitor& v, ContactConfig& contact);
void describe(keys::FieldVisitor& v, SolverConfig& solver);
void describe(keys::FieldVisitor& v, SkipConfig& skip);
void describe(keys::FieldVisitor& v, RatesConfig& rates);
void describe(keys::FieldVisitor& v, HapticsConfig& haptics);

}  // namespace palpate::scene
