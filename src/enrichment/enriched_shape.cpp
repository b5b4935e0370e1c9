// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/enrichment/enriched_shape.h"

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "palpate/enrichment/contact_order.h"

namespace palpate::enrichment {
namespace {

std::vector<std::vector<int>> ordersOf(const Points& points, Eigen::Index contacts,
                                       bool from_contact) {
  std::vector<std::vector<int>> orders;
  if (from_contact) {
    for (Eigen::Index i = 0; i < contacts; ++i) {
      orders.push_back(contactOrder(points, points.col(i)));
    }
  } else {
    orders.emplace_back(static_cast<std::size_t>(points.cols()));
    std::iota(orders[0].begin(), orders[0].end(), 0);
  }
  return orders;
}

// Root mean square distance between columns.
double spreadOf(const Eigen::MatrixXd& features) {
  const Eigen::Index k = features.cols();
  double sum = 0.0;
  for (Eigen::Index j = 1; j < k; ++j) {
    sum += (features.leftCols(j).colwise() - features.col(j)).squaredNorm();
  }
  return k > 1 ? std::sqrt(sum / (0.5 * static_cast<double>(k * (k - 1)))) : 0.0;
}

}  // namespace

EnrichedShape::EnrichedShape(const DeformationDatabase& database, const FeatureSettings& feature,
                             double sigma)
    : settings_(feature),
      places_(mesh::nearestSurfacePoints(database.coarse, database.fine.points)),
      coarse_orders_(ordersOf(database.coarse.points, database.numCoarse(), feature.from_contact)),
      fine_orders_(ordersOf(database.fine.points, database.numCoarse(), feature.from_contact)) {
  const Eigen::Index m = database.numCoarse(), n = database.numFine();
  const auto k = static_cast<Eigen::Index>(database.samples.size());
  if (settings_.points == 0 || settings_.points > m) settings_.points = static_cast<int>(m);
  feature_.resize(3 * settings_.points);
  learned_.resize(3 * n, k);
  lengths_.resize(k);
  Eigen::MatrixXd features(feature_.size(), k);
  Points fine;
  for (Eigen::Index j = 0; j < k; ++j) {
    const Deformation& sample = database.samples[static_cast<std::size_t>(j)];
    if (sample.fine.cols() != n || sample.contact < 0 || sample.contact >= m) {
      throw std::invalid_argument("a sample has not the points of the database");
    }
    const double length = takeFeature(sample.contact, sample.fine);
    features.col(j) = feature_;
    lengths_[j] = length;
    fine = sample.fine;
    if (settings_.residual) {
      interpolate(sample.fine, &interpolated_);
      fine = (fine - interpolated_) / (length > 0.0 ? length : 1.0);
    }
    learned_.col(j) = ordered(fine, orderOf(fine_orders_, sample.contact), n);
  }
  spread_ = spreadOf(features);
  regressor_.emplace(features, sigma);
}

const std::vector<int>& EnrichedShape::orderOf(const std::vector<std::vector<int>>& orders,
                                               int contact) const {
  return orders[settings_.from_contact ? static_cast<std::size_t>(contact) : 0];
}

// Sets the feature and returns its norm; a residual's feature is then normalised.
double EnrichedShape::takeFeature(int contact, const Points& coarse) {
  const std::vector<int>& order = orderOf(coarse_orders_, contact);
  for (Eigen::Index i = 0; i < settings_.points; ++i) {
    feature_.segment<3>(3 * i) = coarse.col(order[static_cast<std::size_t>(i)]);
  }
  const double length = feature_.norm();
  if (settings_.residual && length > 0.0) feature_ /= length;
  return length;
}

// The learned values at the feature, of norm `length`.
void EnrichedShape::mix(int contact, double length, Points* fine) {
  regressor_->weights(feature_, &weights_);
  if (settings_.residual) {
    weights_ *= length * regressor_->nearness();
  } else if (settings_.proportional) {
    const double mean = weights_.dot(lengths_);
    weights_ *= mean > 0.0 ? length / mean : 0.0;
  }
  stacked_.noalias() = learned_ * weights_;
  const std::vector<int>& order = orderOf(fine_orders_, contact);
  fine->resize(3, learned_.rows() / 3);
  for (Eigen::Index i = 0; i < fine->cols(); ++i) {
    fine->col(order[static_cast<std::size_t>(i)]) = stacked_.segment<3>(3 * i);
  }
}

void EnrichedShape::predict(int contact, const Points& coarse, Points* fine) {
  mix(contact, takeFeature(contact, coarse), fine);
  if (!settings_.residual) return;
  interpolate(coarse, &interpolated_);
  *fine += interpolated_;
}

void EnrichedShape::predictDetail(int contact, const Points& coarse, Points* detail) {
  mix(contact, takeFeature(contact, coarse), detail);
  if (settings_.residual) return;
  interpolate(coarse, &interpolated_);
  *detail -= interpolated_;
}

void EnrichedShape::interpolate(const Points& coarse, Points* fine) const {
  mesh::interpolate(places_, coarse, fine);
}

}  // namespace palpate::enrichment
