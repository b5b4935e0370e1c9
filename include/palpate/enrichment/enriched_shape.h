// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "palpate/enrichment/deformations.h"
#include "palpate/enrichment/kernel_regressor.h"
#include "palpate/mesh/surface_points.h"

namespace palpate::enrichment {

/// What of a coarse deformation is compared.
struct FeatureSettings {
  bool from_contact = true;  ///< Points in contactOrder(); else all, as they are numbered.
  int points = 10;           ///< So many of them, the contact's own among them; 0: all.
  /// What is learned is what interpolation on the coarse triangles leaves out of the fine
  /// displacements, per length of the feature, and nothing where no sample is near. Else the fine
  /// displacements themselves, as published: a mean of samples, at rest as well.
  bool residual = false;
  /// Displacements are as much more than the samples' as the feature is longer: what is at rest
  /// stays there.
  bool proportional = false;
};

/// Displacements of a fine surface from those of a coarse one whose points are its first, after
/// samples of both [Bounik, Shamsi, Sedaaghi 2020]. In the order from the contact deformations at
/// one place say something about every other.
class EnrichedShape {
 public:
  /// `sigma` [m]; of residuals, whose features are of length 1, without unit.
  /// @throws std::invalid_argument as KernelRegressor, and for samples of other points.
  EnrichedShape(const DeformationDatabase& database, const FeatureSettings& feature, double sigma);

  /// Of `coarse` the first columns are read, 3 x m [m], pressed at the coarse point `contact`;
  /// `fine`: 3 x n [m]. Allocates nothing when called again.
  void predict(int contact, const Points& coarse, Points* fine);
  /// What that is beside interpolation of `coarse`, in the same sizes.
  void predictDetail(int contact, const Points& coarse, Points* detail);
  /// Interpolation alone.
  void interpolate(const Points& coarse, Points* fine) const;

  /// Root of the mean square distance of the samples' features, a scale for sigma.
  double spread() const { return spread_; }

 private:
  double takeFeature(int contact, const Points& coarse);
  void mix(int contact, double length, Points* fine);
  const std::vector<int>& orderOf(const std::vector<std::vector<int>>& orders, int contact) const;

  FeatureSettings settings_;
  std::vector<mesh::SurfacePoint> places_;                     // of fine points on the coarse
  std::vector<std::vector<int>> coarse_orders_, fine_orders_;  // by contact, or one for all
  Eigen::MatrixXd learned_;                                    // 3n x k, ordered
  double spread_ = 0.0;
  std::optional<KernelRegressor> regressor_;
  Eigen::VectorXd lengths_;  // of the samples' features
  Eigen::VectorXd feature_, weights_, stacked_;
  Points interpolated_;
};

}  // namespace palpate::enrichment
