// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/segment_tracker.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "triangle_tree.h"

namespace palpate::contact {
namespace {

constexpr int kLongestWalk = 64;

// Six times the volume between the line along d through `begin` and the edge from i to j. Both
// triangles at the edge give the same number, apart from the sign.
double side(const Points& x, const Vec3& begin, const Vec3& d, int i, int j) {
  if (i > j) return -side(x, begin, d, j, i);
  return d.dot((x.col(i) - begin).cross(x.col(j) - begin));
}

// Where a line passes a triangle.
struct Passage {
  Vec3 sides;   // of the edges from each corner to the next
  double turn;  // their sum: below 0 where the line goes in

  bool through() const {
    if (turn < 0.0) return sides.maxCoeff() <= 0.0;
    return turn > 0.0 && sides.minCoeff() >= 0.0;
  }
  // The edge beyond which the line passes most.
  int beyond() const {
    int edge = 0;
    (turn < 0.0 ? Vec3(-sides) : sides).minCoeff(&edge);
    return edge;
  }
};

Passage passage(const Points& x, const Eigen::Vector3i& t, const Vec3& begin, const Vec3& d) {
  Passage p;
  for (int k = 0; k < 3; ++k) p.sides[k] = side(x, begin, d, t[k], t[(k + 1) % 3]);
  p.turn = p.sides.sum();
  return p;
}

// Of a line that goes through the triangle.
SegmentHit hitOf(const Points& x, const Eigen::Vector3i& t, int triangle, const Vec3& begin,
                 const Vec3& d, const Passage& p) {
  SegmentHit hit;
  hit.triangle = triangle;
  hit.weights = Vec3(p.sides[1], p.sides[2], p.sides[0]) / p.turn;
  Vec3 point = Vec3::Zero();
  for (int k = 0; k < 3; ++k) point += hit.weights[k] * x.col(t[k]);
  hit.part = d.dot(point - begin) / d.squaredNorm();
  hit.inward = p.turn < 0.0;
  return hit;
}

bool within(const SegmentHit& hit) { return hit.part >= 0.0 && hit.part <= 1.0; }

Eigen::Matrix3Xi neighboursOf(const Eigen::Matrix3Xi& triangles) {
  std::map<std::pair<int, int>, std::vector<int>> of;  // an edge, as it goes round each triangle
  for (int t = 0; t < triangles.cols(); ++t) {
    for (int k = 0; k < 3; ++k) {
      of[{triangles(k, t), triangles((k + 1) % 3, t)}].push_back(t);
    }
  }
  Eigen::Matrix3Xi beside = Eigen::Matrix3Xi::Constant(3, triangles.cols(), -1);
  for (int t = 0; t < triangles.cols(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto other = of.find({triangles((k + 1) % 3, t), triangles(k, t)});
      if (other != of.end() && other->second.size() == 1) beside(k, t) = other->second.front();
    }
  }
  return beside;
}

}  // namespace

struct SegmentTracker::Tree {
  TriangleTree tree;
  std::vector<TriangleTree::Box> boxes;
};

SegmentTracker::SegmentTracker(const Points& X, const Eigen::Matrix3Xi& triangles)
    : triangles_(triangles),
      neighbours_(neighboursOf(triangles)),
      tree_(std::make_unique<Tree>(Tree{TriangleTree(X, triangles), {}})) {
  fit(X);
}

SegmentTracker::~SegmentTracker() = default;

void SegmentTracker::fit(const Points& x) { tree_->tree.fit(x, triangles_, &tree_->boxes); }

void SegmentTracker::find(const Points& x, const Vec3& begin, const Vec3& end,
                          std::vector<SegmentHit>* hits) {
  ++counts_.queries;
  hits->clear();
  const Vec3 d = end - begin;
  tree_->tree.forSegment(tree_->boxes, begin, end, [&](int t) {
    const Passage p = passage(x, triangles_.col(t), begin, d);
    if (!p.through()) return;
    const SegmentHit hit = hitOf(x, triangles_.col(t), t, begin, d, p);
    if (within(hit)) hits->push_back(hit);
  });
  std::sort(hits->begin(), hits->end(), [](const SegmentHit& a, const SegmentHit& b) {
    return std::tie(a.part, a.triangle) < std::tie(b.part, b.triangle);
  });
}

std::optional<SegmentHit> SegmentTracker::walk(const Points& x, const Vec3& begin, const Vec3& end,
                                               int triangle) {
  ++counts_.walks;
  const Vec3 d = end - begin;
  Passage p = passage(x, triangles_.col(triangle), begin, d);
  const bool inward = p.turn < 0.0;
  for (int step = 0; step < kLongestWalk && p.turn != 0.0 && (p.turn < 0.0) == inward; ++step) {
    if (p.through()) return hitOf(x, triangles_.col(triangle), triangle, begin, d, p);
    triangle = neighbours_(p.beyond(), triangle);
    if (triangle < 0) break;
    ++counts_.steps;
    p = passage(x, triangles_.col(triangle), begin, d);
  }
  ++counts_.lost;
  return std::nullopt;
}

}  // namespace palpate::contact
