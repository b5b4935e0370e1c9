// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/enrichment/contact_order.h"

#include <algorithm>
#include <numeric>

namespace palpate::enrichment {

std::vector<int> contactOrder(const Points& points, const Vec3& contact) {
  const Eigen::VectorXd away = (points.colwise() - contact).colwise().squaredNorm().transpose();
  std::vector<int> order(static_cast<std::size_t>(points.cols()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return away[a] < away[b]; });
  return order;
}

Eigen::VectorXd ordered(const Points& values, const std::vector<int>& order, Eigen::Index count) {
  Eigen::VectorXd stacked(3 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    stacked.segment<3>(3 * i) = values.col(order[static_cast<std::size_t>(i)]);
  }
  return stacked;
}

}  // namespace palpate::enrichment
