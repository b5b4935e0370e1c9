// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "palpate/keys/fields.h"
#include "palpate/mesh/selection.h"

namespace palpate::tissue {

/// Of an organ of model hybrid: which part moves as tensors, and what it and the rest tell each
/// other.
struct HybridSettings {
  std::optional<mesh::TetRegion> region;  ///< Of tensors, in the organ's frame.
  std::string exchange = "monolithic";    ///< monolithic | loop
};

void describe(keys::FieldVisitor& v, HybridSettings& hybrid);

}  // namespace palpate::tissue
