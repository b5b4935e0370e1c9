// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/sim/body_config.h"
#include "palpate/sim/fields.h"
#include "palpate/solver/integrator.h"

namespace palpate::sim {

// Every key of what a body is made of, the same in scene and case files.
void describe(FieldVisitor& v, MaterialConfig& material);
void describe(FieldVisitor& v, material::PronyTerm& term);
void describe(FieldVisitor& v, FibreConfig& fibres);
void describe(FieldVisitor& v, RegionConfig& region);
void describe(FieldVisitor& v, BodyConfig& body);
void describe(FieldVisitor& v, solver::RayleighDamping& damping);
void describe(FieldVisitor& v, mesh::TetRegion& region);
void describe(FieldVisitor& v, mesh::HalfSpaceRegion& half_space);
void describe(FieldVisitor& v, mesh::CellDataRegion& cell_data);
void describe(FieldVisitor& v, mesh::DepthRegion& depth);

/// The keys of a material that is written out: law, constants, density, viscoelastic.
void describeLaw(FieldVisitor& v, MaterialConfig& material);

}  // namespace palpate::sim
