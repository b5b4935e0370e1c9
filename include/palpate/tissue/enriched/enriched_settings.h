// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/enrichment/database_plan.h"
#include "palpate/keys/fields.h"

namespace palpate::tissue {

/// Settings of an organ of model enriched: the fine surface carried by its finite elements, and its
/// training data.
struct EnrichedSettings {
  std::string detail = "residual";  ///< residual | displacement | none
  std::string database;             ///< Folder; empty: it is made as planned.
  enrichment::DatabasePlan plan;
  double sigma = 0.3;  ///< In spreads of the samples' features.
  double time = 0.05;  ///< In which learned detail comes and goes [s].
};

void describe(keys::FieldVisitor& v, EnrichedSettings& enriched);

}  // namespace palpate::tissue
