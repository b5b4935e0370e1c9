// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/keys/fields.h"
#include "palpate/mesh/size_field.h"

namespace palpate::scene {

/// Where an organ's edges are to be short: a place of the mesh's size field, or the way of a tool.
struct RefinementZoneConfig : mesh::RefinementZone {
  std::string trajectory;  ///< A table of joint positions: the place is the way of
  std::string instrument;  ///< this instrument's control frame; empty: of the only one.
};

/// How long the edges of an organ's tetrahedra are to be, in the organ's own frame, after scaling.
struct EdgeLengthConfig {
  double coarsest = 0.01;  ///< [m]
  std::vector<RefinementZoneConfig> near;

  bool uniform() const { return near.empty(); }
};

/// The lengths that an edge may be asked to have [m].
inline keys::Range edgeLengthRange() { return keys::Range::closed(1.0e-4, 1.0); }

void describe(keys::FieldVisitor& v, EdgeLengthConfig& edge_length);
void describe(keys::FieldVisitor& v, RefinementZoneConfig& place);

}  // namespace palpate::scene
