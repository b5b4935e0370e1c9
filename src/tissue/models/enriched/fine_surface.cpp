// SPDX-License-Identifier: GPL-3.0-or-later
#include "fine_surface.h"

#include <utility>

namespace palpate::tissue {

FineSurface::FineSurface(const mesh::SurfaceMesh& coarse, mesh::SurfaceMesh fine, double spacing)
    : fine_(std::move(fine)),
      places_(mesh::nearestSurfacePoints(coarse, fine_.points)),
      on_fine_(contact::sampleSurface(fine_.points, fine_.triangles, spacing)) {
  carried(coarse.points, &distance_);
  distance_ = fine_.points - distance_;
  Points at(3, static_cast<Eigen::Index>(on_fine_.size()));
  for (std::size_t s = 0; s < on_fine_.size(); ++s) {
    at.col(static_cast<Eigen::Index>(s)) = on_fine_[s].position(fine_.points);
  }
  const std::vector<mesh::SurfacePoint> places = mesh::nearestSurfacePoints(coarse, at);
  for (std::size_t s = 0; s < on_fine_.size(); ++s) {
    contact::SurfaceSample sample{places[s].nodes, places[s].weights, on_fine_[s].area};
    sample.offset = at.col(static_cast<Eigen::Index>(s)) - sample.of(coarse.points);
    on_fine_[s].offset = sample.offset;
    samples_.push_back(sample);
  }
}

void FineSurface::offsets(const Points& detail, Points* offsets) const {
  offsets->resize(3, static_cast<Eigen::Index>(on_fine_.size()));
  for (std::size_t s = 0; s < on_fine_.size(); ++s) {
    offsets->col(static_cast<Eigen::Index>(s)) = on_fine_[s].position(detail);
  }
}

}  // namespace palpate::tissue
