// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/enrichment/enriched_shape.h"

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "palpate/enrichment/contact_order.h"

namespace palpate::enrichment {

EnrichedShape::EnrichedShape(const DeformationDatabase& database, const FeatureSettings& feature,
                             double sigma)
    : settings_(feature), coarse_orders_(1), fine_orders_(1) {
  const Eigen::Index m = database.numCoarse(), n = database.numFine();
  const auto k = static_cast<Eigen::Index>(database.samples.size());
  if (settings_.points == 0 || settings_.points > m) settings_.points = static_cast<int>(m);
  const auto place = [&](int contact) -> Vec3 { return database.coarse.points.col(contact); };
  if (settings_.from_contact) {
    coarse_orders_.clear();
    fine_orders_.clear();
    for (int contact = 0; contact < m; ++contact) {
      coarse_orders_.push_back(contactOrder(database.coarse.points, place(contact)));
      fine_orders_.push_back(contactOrder(database.fine.points, place(contact)));
    }
  } else {
    coarse_orders_[0].resize(static_cast<std::size_t>(m));
    fine_orders_[0].resize(static_cast<std::size_t>(n));
    std::iota(coarse_orders_[0].begin(), coarse_orders_[0].end(), 0);
    std::iota(fine_orders_[0].begin(), fine_orders_[0].end(), 0);
  }
  fine_samples_.resize(3 * n, k);
  Eigen::MatrixXd features(3 * settings_.points, k);
  for (Eigen::Index j = 0; j < k; ++j) {
    const Deformation& sample = database.samples[static_cast<std::size_t>(j)];
    if (sample.fine.cols() != n || sample.contact < 0 || sample.contact >= m) {
      throw std::invalid_argument("a sample has not the points of the database");
    }
    features.col(j) = this->feature(sample.contact, sample.fine);
    fine_samples_.col(j) = ordered(sample.fine, orderOf(fine_orders_, sample.contact), n);
  }
  double sum = 0.0;
  for (Eigen::Index j = 1; j < k; ++j) {
    sum += (features.leftCols(j).colwise() - features.col(j)).squaredNorm();
  }
  spread_ = k > 1 ? std::sqrt(sum / (0.5 * static_cast<double>(k * (k - 1)))) : 0.0;
  regressor_.emplace(features, sigma);
}

const std::vector<int>& EnrichedShape::orderOf(const std::vector<std::vector<int>>& orders,
                                               int contact) const {
  return orders[settings_.from_contact ? static_cast<std::size_t>(contact) : 0];
}

Eigen::VectorXd EnrichedShape::feature(int contact, const Points& coarse) const {
  return ordered(coarse, orderOf(coarse_orders_, contact), settings_.points);
}

void EnrichedShape::predict(int contact, const Points& coarse, Points* fine) const {
  Eigen::VectorXd weights;
  regressor_->weights(feature(contact, coarse), &weights);
  const Eigen::VectorXd stacked = fine_samples_ * weights;
  const std::vector<int>& order = orderOf(fine_orders_, contact);
  fine->resize(3, fine_samples_.rows() / 3);
  for (Eigen::Index i = 0; i < fine->cols(); ++i) {
    fine->col(order[static_cast<std::size_t>(i)]) = stacked.segment<3>(3 * i);
  }
}

}  // namespace palpate::enrichment
