// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

namespace palpate::tissue {

/// By which part the force on a ball is too large because edges are long: `ratio` is the mean edge
/// that the ball presses on by its radius. A power law, fitted to a ball pressed into a block
/// by 1.6 of its radius (docs/meshes.md); what a tool presses less deep or with an edge feels
/// differs by half of it. Nothing for elements that were not measured.
std::optional<double> forceExcess(const std::string& element, double ratio);

/// The ratio at which the force is too large by that part. `excess` > 0.
std::optional<double> edgeRatioFor(const std::string& element, double excess);

}  // namespace palpate::tissue
