// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/io/case.h"
#include "palpate/sim/fields.h"

namespace palpate::io {

// Every key of a case file.
void describe(sim::FieldVisitor& v, Case& c);
void describe(sim::FieldVisitor& v, CaseMesh& mesh);
void describe(sim::FieldVisitor& v, BoxMesh& box);
void describe(sim::FieldVisitor& v, BoundaryCondition& condition);
void describe(sim::FieldVisitor& v, Rotation& rotation);
void describe(sim::FieldVisitor& v, std::variant<StaticAnalysis, DynamicAnalysis>& analysis);
void describe(sim::FieldVisitor& v, Probe& probe);

}  // namespace palpate::io
