// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "palpate/enrichment/deformations.h"
#include "palpate/enrichment/kernel_regressor.h"

namespace palpate::enrichment {

/// What of a coarse deformation is compared.
struct FeatureSettings {
  bool from_contact = true;  ///< Points in contactOrder(); else all, as they are numbered.
  int points = 10;           ///< So many of them, the contact's own among them; 0: all.
};

/// Displacements of a fine surface from those of a coarse one whose points are its first, after
/// samples of both [Bounik, Shamsi, Sedaaghi 2020]. In the order from the contact deformations at
/// one place say something about every other.
class EnrichedShape {
 public:
  /// @throws std::invalid_argument as KernelRegressor, and for samples of other points.
  EnrichedShape(const DeformationDatabase& database, const FeatureSettings& feature, double sigma);

  /// Of `coarse` the first columns are read, 3 x m [m], pressed at the coarse point `contact`;
  /// `fine`: 3 x n [m].
  void predict(int contact, const Points& coarse, Points* fine) const;

  /// Root of the mean square distance of the samples' features, a scale for sigma [m].
  double spread() const { return spread_; }

 private:
  Eigen::VectorXd feature(int contact, const Points& coarse) const;
  const std::vector<int>& orderOf(const std::vector<std::vector<int>>& orders, int contact) const;

  FeatureSettings settings_;
  std::vector<std::vector<int>> coarse_orders_, fine_orders_;  // by contact, or one for all
  Eigen::MatrixXd fine_samples_;                               // 3n x k, ordered
  double spread_ = 0.0;
  std::optional<KernelRegressor> regressor_;
};

}  // namespace palpate::enrichment
