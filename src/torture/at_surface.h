// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/tissue/tissue_model.h"

namespace palpate::torture {

/// A point on a triangle of a surface.
struct OnSurface {
  Eigen::Vector3i corners = Eigen::Vector3i::Zero();
  Vec3 weights = Vec3::Zero();  ///< Barycentric, >= 0, sum 1.
};

/// The point of all triangles nearest to p_W [m].
OnSurface nearestOnSurface(const tissue::SurfaceState& shape, const Vec3& p_W);

}  // namespace palpate::torture
