// SPDX-License-Identifier: GPL-3.0-or-later
#include "coarse_groups.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace palpate::solver {
namespace {

constexpr double kLeastPart = 0.01;  // smaller weights are not worth their cost

struct Near {
  double squared_distance = std::numeric_limits<double>::infinity();
  int group = 0;
};
// The nearest groups, and one more.
using Nearest = std::array<Near, kGroupsOfANode + 1>;

Nearest nearest(const Points& middles, const Vec3& p) {
  Nearest found;
  for (int g = 0; g < static_cast<int>(middles.cols()); ++g) {
    const double squared = (middles.col(g) - p).squaredNorm();
    if (!(squared < found.back().squared_distance)) continue;
    std::size_t k = found.size() - 1;
    for (; k > 0 && squared < found[k - 1].squared_distance; --k) found[k] = found[k - 1];
    found[k] = {squared, g};
  }
  return found;
}

}  // namespace

CoarseGroups::CoarseGroups(const Points& points, const SliceOrder& nodes, int size)
    : middle(Points::Zero(3, (nodes.count() + size - 1) / size)),
      radius(Eigen::VectorXd::Zero(middle.cols())),
      group(static_cast<std::size_t>(kGroupsOfANode) * nodes.count(), 0),
      weight(group.size(), 0.0) {
  Eigen::VectorXd members = radius;
  for (int i = 0; i < nodes.count(); ++i) {
    middle.col(nodes.rank(i) / size) += points.col(i);
    members[nodes.rank(i) / size] += 1.0;
  }
  middle *= members.cwiseInverse().asDiagonal();
  for (int i = 0; i < nodes.count(); ++i) {
    const int own = nodes.rank(i) / size;
    radius[own] = std::max(radius[own], (points.col(i) - middle.col(own)).norm());
    const Nearest found = nearest(middle, points.col(i));
    int* groups = group.data() + static_cast<std::ptrdiff_t>(kGroupsOfANode) * i;
    double* weights = weight.data() + static_cast<std::ptrdiff_t>(kGroupsOfANode) * i;
    double sum = 0.0;
    for (int k = 0; k < kGroupsOfANode; ++k) {
      const double part =
          1.0 - std::sqrt(found[k].squared_distance / found.back().squared_distance);
      groups[k] = found[k].group;
      weights[k] = part > kLeastPart ? part : 0.0;
      sum += weights[k];
    }
    if (!(sum > 0.0)) weights[0] = sum = 1.0;
    for (int k = 0; k < kGroupsOfANode; ++k) weights[k] /= sum;
  }
}

}  // namespace palpate::solver
