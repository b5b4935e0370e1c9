// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangle_tree.h"

#include <algorithm>
#include <numeric>

namespace palpate::contact {
namespace {

constexpr int kFewest = 4;

}  // namespace

TriangleTree::TriangleTree(const Points& X, const Eigen::Matrix3Xi& triangles) {
  const Eigen::Index count = triangles.cols();
  Points middles(3, count);
  for (Eigen::Index t = 0; t < count; ++t) {
    middles.col(t) =
        (X.col(triangles(0, t)) + X.col(triangles(1, t)) + X.col(triangles(2, t))) / 3.0;
  }
  order_.resize(static_cast<std::size_t>(count));
  std::iota(order_.begin(), order_.end(), 0);
  split(0, static_cast<int>(count), middles);
}

void TriangleTree::split(int begin, int end, const Points& middles) {
  const std::size_t own = nodes_.size();
  nodes_.push_back({-1, begin, end});
  nodes_[own].next = static_cast<int>(own) + 1;
  if (end - begin <= kFewest) return;
  Box box;
  for (int k = begin; k < end; ++k) box.extend(Vec3(middles.col(order_[k])));
  int along = 0;
  box.sizes().maxCoeff(&along);
  const int half = begin + (end - begin) / 2;
  std::nth_element(
      order_.begin() + begin, order_.begin() + half, order_.begin() + end, [&](int s, int t) {
        return std::make_pair(middles(along, s), s) < std::make_pair(middles(along, t), t);
      });
  split(begin, half, middles);
  nodes_[own].second = static_cast<int>(nodes_.size());
  split(half, end, middles);
  nodes_[own].next = static_cast<int>(nodes_.size());
}

void TriangleTree::fit(const Eigen::Ref<const Points>& x, const Eigen::Matrix3Xi& triangles,
                       std::vector<Box>* boxes) const {
  boxes->resize(nodes_.size());
  for (std::size_t k = nodes_.size(); k-- > 0;) {
    Box& box = (*boxes)[k];
    if (nodes_[k].second >= 0) {
      box = (*boxes)[k + 1].merged((*boxes)[static_cast<std::size_t>(nodes_[k].second)]);
      continue;
    }
    box.setEmpty();
    for (int t = nodes_[k].begin; t < nodes_[k].end; ++t) {
      for (int c = 0; c < 3; ++c) box.extend(Vec3(x.col(triangles(c, order_[t]))));
    }
  }
}

}  // namespace palpate::contact
