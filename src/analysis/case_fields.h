// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/analysis/case.h"
#include "palpate/keys/fields.h"

namespace palpate::analysis {

// All keys of a case file.
void describe(keys::FieldVisitor& v, Case& c);
void describe(keys::FieldVisitor& v, CaseMesh& mesh);
void describe(keys::FieldVisitor& v, BoxMesh& box);
void describe(keys::FieldVisitor& v, BoundaryCondition& condition);
void describe(keys::FieldVisitor& v, Rotation& rotation);
void describe(keys::FieldVisitor& v, std::variant<StaticAnalysis, DynamicAnalysis>& analysis);
void describe(keys::FieldVisitor& v, Probe& probe);

}  // namespace palpate::analysis
