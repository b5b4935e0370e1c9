// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "palpate/enrichment/deformations.h"
#include "palpate/enrichment/kernel_regressor.h"
#include "palpate/mesh/surface_points.h"

namespace palpate::enrichment {

/// Features of a coarse deformation for comparison.
struct FeatureSettings {
  bool from_contact = true;  ///< Points in contactOrder(); else in their own order.
  int points = 10;           ///< Number of points, with the contact's own; 0: all.
  /// Learn residuals: fine displacements minus interpolation on coarse triangles, over the norm of
  /// the feature, zero far from all samples. Else the fine displacements, as published: means of
  /// samples, also at rest.
  bool residual = false;
  /// Scale displacements by the feature's norm over that of the samples, so that rest is exact.
  bool proportional = false;
};

/// Maps displacements of a coarse surface to those of a fine one, whose first points are the coarse
/// ones, from samples of both [Bounik, Shamsi, Sedaaghi 2020]. Points ordered from the contact make
/// samples at one contact valid at others.
class EnrichedShape {
 public:
  /// `sigma` [m]; dimensionless for residuals, whose features have norm 1.
  /// @throws std::invalid_argument as KernelRegressor, and for samples with other points.
  EnrichedShape(const DeformationDatabase& database, const FeatureSettings& feature, double sigma);

  /// Reads the first columns of `coarse`, 3 x m [m], for a press at the coarse point `contact`;
  /// `fine`: 3 x n [m]. Repeated calls do not allocate.
  void predict(int contact, const Points& coarse, Points* fine);
  /// predict() minus interpolation of `coarse`, with the same sizes.
  void predictDetail(int contact, const Points& coarse, Points* detail);
  /// Interpolation of `coarse` only.
  void interpolate(const Points& coarse, Points* fine) const;

  /// Root mean square distance of the samples' features, a scale for sigma.
  double spread() const { return spread_; }

 private:
  double takeFeature(int contact, const Points& coarse);
  void mix(int contact, double length, Points* fine);
  const std::vector<int>& orderOf(const std::vector<std::vector<int>>& orders, int contact) const;

  FeatureSettings settings_;
  std::vector<mesh::SurfacePoint> places_;                     // fine points on the coarse
  std::vector<std::vector<int>> coarse_orders_, fine_orders_;  // per contact, or one for all
  Eigen::MatrixXd learned_;                                    // 3n x k, ordered
  double spread_ = 0.0;
  std::optional<KernelRegressor> regressor_;
  Eigen::VectorXd lengths_;  // norms of the samples' features
  Eigen::VectorXd feature_, weights_, stacked_;
  Points interpolated_;
};

}  // namespace palpate::enrichment
