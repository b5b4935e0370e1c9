// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/keys/fields.h"
#include "palpate/mesh/size_field.h"

namespace palpate::scene {

/// A refinement zone of an organ: a zone of the mesh's size field, or a tool's path.
struct RefinementZoneConfig : mesh::RefinementZone {
  std::string trajectory;  ///< Joint positions of a tool whose path is the zone.
  std::string instrument;  ///< Tool of that path by its control frame; empty: the only one.
};

/// Edge lengths of an organ's tetrahedra, in the organ's frame, after scaling.
struct EdgeLengthConfig {
  double coarsest = 0.01;  ///< [m]
  std::vector<RefinementZoneConfig> near;

  bool uniform() const { return near.empty(); }
};

/// Allowed edge lengths [m].
inline keys::Range edgeLengthRange() { return keys::Range::closed(1.0e-4, 1.0); }

void describe(keys::FieldVisitor& v, EdgeLengthConfig& edge_length);
void describe(keys::FieldVisitor& v, RefinementZoneConfig& place);

}  // namespace palpate::scene
