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

/// Learned detail of a fine surface, as a function of tool contacts and displacements of the
/// samples' coarse points.
class LearnedDetail {
 public:
  /// `database`: in the organ's frame O at X_WO; `body`: coarse surface of `fine`, rest
  /// configuration, world [m].
  /// @throws std::invalid_argument as enrichment::EnrichedShape.
  LearnedDetail(const EnrichedSettings& settings, const enrichment::DeformationDatabase& database,
                const Pose& X_WO, const mesh::SurfaceMesh& body);

  /// Detail of the fine points, 3 x n [m], for displacements `u` of the body's nodes, 3 x m [m],
  /// and `contacts`; zero without contact. Allocates in the first call only.
  void find(const std::vector<TissueContact>& contacts, const Points& u, const FineSurface& fine,
            Points* detail);

 private:
  void gatherTools(const std::vector<TissueContact>& contacts);
  int nearestPoint(const Vec3& p_W) const;

  struct Tool {
    double force = 0.0;
    Vec3 sum = Vec3::Zero();  // of contact positions, weighted by force
  };

  std::optional<enrichment::EnrichedShape> shape_;  // none: no detail
  bool residual_;
  Mat3 R_WO_;
  Points coarse_;                                  // rest positions, world [m]
  std::vector<mesh::SurfacePoint> coarse_places_;  // on the body
  std::vector<Tool> tools_;                        // by instrument
  Points moved_W_, moved_O_, learned_, carried_;
};

}  // namespace palpate::tissue
