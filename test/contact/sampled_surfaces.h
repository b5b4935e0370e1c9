// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/instrument/geometry.h"
#include "support/concave_surfaces.h"

namespace palpate::contact {

inline instrument::SampledSurface sampled(const mesh::SurfaceMesh& surface,
                                          const mesh::DistanceGridSettings& settings = {}) {
  return {std::make_shared<const mesh::DistanceGrid>(mesh::makeDistanceGrid(surface, settings))};
}

/// A U about the origin, four times as large and with its opening downwards (-z).
inline instrument::SampledSurface sampledLargeU() {
  mesh::SurfaceMesh surface = test::uSurface();
  const Vec3 middle(0.0075, 0.0025, 0.0075);
  surface.points = 4.0 * (surface.points.colwise() - middle);
  surface.points.bottomRows(2) *= -1.0;
  return sampled(surface, {64, 1e-2, 64.0});
}

}  // namespace palpate::contact
