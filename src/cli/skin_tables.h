// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/skin/published_tables.h"
#include "palpate/skin/sweep.h"

namespace palpate::cli {

// Tables of `palpate skin`. Each replaces the file whole. @throws InputError if it cannot be
// written

/// A row a point and set.
void writeSweep(const std::string& file, const skin::TwoLayerBlock& block,
                const std::vector<skin::SweepPoint>& points);

/// A row a reading: radius, what was read, and the model's depth [m].
void writeProfiles(const std::string& file, const skin::UnitIndentation& unit,
                   const std::vector<double>& depths);

/// Nodes: x, z and displacements by depth. Triangles: their nodes and layer.
void writeBlock(const std::string& nodes, const std::string& triangles,
                const skin::UnitIndentation& unit);

void writePublished(const std::string& file, const std::vector<skin::PublishedFigure>& figures);

}  // namespace palpate::cli
