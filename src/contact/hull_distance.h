// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/contact/triangle_distance.h"
#include "palpate/instrument/geometry.h"

namespace palpate::contact {

struct Nearest {
  double value;     ///< Signed distance [m].
  Vec3 normal;      ///< Unit, outward.
  Feature feature;  ///< kFace inside.
  Vec3 tangent;     ///< Unit, along the edge if `feature` is kEdge; else zero.
};

/// Signed distance of p from a convex polyhedron: to the nearest triangle outside, to the nearest
/// plane inside, the first of equally near ones.
Nearest nearestOnHull(const instrument::ConvexHull& hull, const Vec3& p);

}  // namespace palpate::contact
