// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

namespace palpate::tissue {

/// Relative excess of the force on a ball due to the mesh size [-]; `ratio`: mean edge over the
/// ball's radius [-]. A power law, fitted to a ball pressed into a block by 1.6 of its radius
/// (docs/meshes.md); for shallow presses or edges it is off by half. None for elements without
/// measurement.
std::optional<double> forceExcess(const std::string& element, double ratio);

/// Inverse of forceExcess(): the ratio for a relative excess. `excess` > 0.
std::optional<double> edgeRatioFor(const std::string& element, double excess);

}  // namespace palpate::tissue
