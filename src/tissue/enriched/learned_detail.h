// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fine_surface.h"
#include "palpate/enrichment/enriched_shape.h"
#include "palpate/tissue/enriched/enriched_settings.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// What samples say of a fine surface beside what carries it, from where tools touch and how the
/// coarse points of the samples moved.
class LearnedDetail {
 public:
  /// `database`: in the organ's frame, which is X_WO in the world. `body`: the surface that carries
  /// `fine`, at rest in the world.
  /// @throws std::invalid_argument as enrichment::EnrichedShape.
  LearnedDetail(const EnrichedSettings& settings, const enrichment::DeformationDatabase& database,
                const Pose& X_WO, const mesh::SurfaceMesh& body);

  /// The detail of the fine points [m], 3 x n, where the body's nodes moved by `u` (3 x m) and
  /// tools touch as `contacts` say; zero where none does. Allocates nothing when called again.
  void find(const std::vector<TissueContact>& contacts, const Points& u, const FineSurface& fine,
            Points* detail);

 private:
  void gatherTools(const std::vector<TissueContact>& contacts);
  int nearestPoint(const Vec3& p_W) const;

  struct Tool {
    double force = 0.0;
    Vec3 sum = Vec3::Zero();  // of places by force
  };

  std::optional<enrichment::EnrichedShape> shape_;  // none: there is no detail
  bool residual_;
  Mat3 R_WO_;
  Points coarse_;                                  // at rest in the world
  std::vector<mesh::SurfacePoint> coarse_places_;  // on the body
  std::vector<Tool> tools_;                        // by instrument
  Points moved_W_, moved_O_, learned_, carried_;
};

}  // namespace palpate::tissue
