// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::contact {

/// Binary tree of bounding boxes over triangles, split along the longest side at rest down to four
/// triangles. Boxes of a moving surface are stored by the caller.
class TriangleTree {
 public:
  using Box = Eigen::AlignedBox3d;

  /// `X` 3 x n [m], `triangles` 3 x m, m > 0.
  TriangleTree(const Points& X, const Eigen::Matrix3Xi& triangles);

  /// Computes the boxes of all nodes at x, that of the whole surface first.
  void fit(const Eigen::Ref<const Points>& x, const Eigen::Matrix3Xi& triangles,
           std::vector<Box>* boxes) const;

  /// Calls visit(triangle) for all boxes not farther from `box` than reach() [m], which may
  /// decrease meanwhile; nearer branches first.
  template <class Reach, class Visit>
  void forNear(const std::vector<Box>& boxes, const Box& box, const Reach& reach,
               const Visit& visit) const {
    std::array<std::pair<int, double>, kDeepest> left;
    std::size_t size = 0;
    left[size++] = {0, squaredDistance(boxes[0], box)};
    while (size > 0) {
      const auto [at, squared] = left[--size];
      const double r = reach();
      if (!(r >= 0.0 && squared <= r * r)) continue;
      const Node& node = nodes_[static_cast<std::size_t>(at)];
      if (node.second < 0) {
        for (int k = node.begin; k < node.end; ++k) visit(order_[static_cast<std::size_t>(k)]);
        continue;
      }
      const std::pair<int, double> first{at + 1, squaredDistance(boxes[at + 1], box)};
      const std::pair<int, double> second{node.second, squaredDistance(boxes[node.second], box)};
      const bool nearer = first.second <= second.second;
      left[size++] = nearer ? second : first;
      left[size++] = nearer ? first : second;
    }
  }

  /// Calls visit(triangle) for all boxes that the ray from `from` along `direction` intersects.
  template <class Visit>
  void forRay(const std::vector<Box>& boxes, const Vec3& from, const Vec3& direction,
              const Visit& visit) const {
    const Vec3 inverse = direction.cwiseInverse();
    for (std::size_t k = 0; k < nodes_.size();) {
      const Node& node = nodes_[k];
      const Vec3 one = (boxes[k].min() - from).cwiseProduct(inverse);
      const Vec3 other = (boxes[k].max() - from).cwiseProduct(inverse);
      const bool meets =
          one.cwiseMax(other).minCoeff() >= std::max(0.0, one.cwiseMin(other).maxCoeff());
      if (!meets) {
        k = static_cast<std::size_t>(node.next);
        continue;
      }
      if (node.second < 0) {
        for (int t = node.begin; t < node.end; ++t) visit(order_[static_cast<std::size_t>(t)]);
      }
      ++k;
    }
  }

  /// Calls visit(triangle) for all boxes that the segment intersects, by separating axes [Ericson
  /// 2005, Real-time collision detection, sec. 5.3.3].
  template <class Visit>
  void forSegment(const std::vector<Box>& boxes, const Vec3& begin, const Vec3& end,
                  const Visit& visit) const {
    const Vec3 middle = 0.5 * (begin + end), half = 0.5 * (end - begin), way = half.cwiseAbs();
    for (std::size_t k = 0; k < nodes_.size();) {
      const Node& node = nodes_[k];
      // Conservative against rounding.
      const Vec3 room = 0.5 * (1.0 + 1e-9) * boxes[k].sizes() + 1e-12 * (way + middle.cwiseAbs());
      const Vec3 off = middle - boxes[k].center(), turned = half.cross(off).cwiseAbs();
      bool meets = (off.cwiseAbs().array() <= (room + way).array()).all();
      for (int c = 0; meets && c < 3; ++c) {
        const int i = (c + 1) % 3, j = (c + 2) % 3;
        meets = turned[c] <= room[i] * way[j] + room[j] * way[i];
      }
      if (!meets) {
        k = static_cast<std::size_t>(node.next);
        continue;
      }
      if (node.second < 0) {
        for (int t = node.begin; t < node.end; ++t) visit(order_[static_cast<std::size_t>(t)]);
      }
      ++k;
    }
  }

 private:
  static constexpr std::size_t kDeepest = 64;  // halves: of 2^64 triangles
  struct Node {
    int second;      ///< Index of the second child; the first follows the node. -1: leaf.
    int begin, end;  ///< Range of `order_`.
    int next = 0;    ///< Index after the subtree.
  };
  static double squaredDistance(const Box& a, const Box& b) { return a.squaredExteriorDistance(b); }
  void split(int begin, int end, const Points& middles);

  std::vector<Node> nodes_;
  std::vector<int> order_;
};

}  // namespace palpate::contact
