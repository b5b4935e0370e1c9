// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/mesh/selection.h"
#include "palpate/sim/body_fields.h"
#include "palpate/sim/fields.h"
#include "palpate/sim/scene.h"

namespace palpate::sim {

/// The range of a coordinate: a scene is a room, not a town.
Range coordinateRange();

// Every key of a scene file; the case file shares the body and the region.
void describe(FieldVisitor& v, Scene& scene);
void describe(FieldVisitor& v, OrganConfig& organ);
void describe(FieldVisitor& v, PoseConfig& pose);
void describe(FieldVisitor& v, SupportConfig& support);
void describe(FieldVisitor& v, InstrumentConfig& instrument);
void describe(FieldVisitor& v, ContactConfig& contact);
void describe(FieldVisitor& v, SolverConfig& solver);
void describe(FieldVisitor& v, SkipConfig& skip);
void describe(FieldVisitor& v, RatesConfig& rates);
void describe(FieldVisitor& v, HapticsConfig& haptics);
void describe(FieldVisitor& v, mesh::Region& region);
void describe(FieldVisitor& v, mesh::PlaneRegion& plane);
void describe(FieldVisitor& v, mesh::BoxRegion& box);
void describe(FieldVisitor& v, mesh::SphereRegion& sphere);

}  // namespace palpate::sim
