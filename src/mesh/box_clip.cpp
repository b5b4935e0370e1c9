// SPDX-License-Identifier: GPL-3.0-or-later
#include "box_clip.h"

#include <cmath>
#include <utility>

namespace palpate::mesh {

std::vector<BoxFace> facesOf(const CutBox& box) {
  std::vector<BoxFace> faces;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::isfinite(box.low[axis])) faces.push_back({axis, box.low[axis], 1});
    if (std::isfinite(box.high[axis])) faces.push_back({axis, box.high[axis], -1});
  }
  return faces;
}

CornerDepths::CornerDepths(const Eigen::Matrix<double, 3, 4>& x, const std::vector<BoxFace>& faces,
                           double close) {
  for (const BoxFace& face : faces) {
    Eigen::Vector4d depth = face.into * (x.row(face.axis).transpose().array() - face.at).matrix();
    for (double& d : depth) {
      if (std::abs(d) < close) d = 0.0;
    }
    depths_.push_back(depth);
  }
}

// [Sutherland, Hodgman 1974], one plane.
CutPolygon CornerDepths::clip(const CutPolygon& polygon, std::size_t face, bool inside) const {
  const Eigen::Vector4d depth = inside ? depths_[face] : Eigen::Vector4d(-depths_[face]);
  CutPolygon left;
  const std::size_t n = polygon.vertices.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Eigen::Vector4d &a = polygon.vertices[k], &b = polygon.vertices[(k + 1) % n];
    const double da = depth.dot(a), db = depth.dot(b);
    if (da >= 0.0) left.vertices.push_back(a);
    if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) {
      left.vertices.emplace_back(a + da / (da - db) * (b - a));
    }
  }
  if (left.vertices.size() < 3) left.vertices.clear();
  return left;
}

// Face by face: the part before the face is outside, the rest continues to the next face.
void CornerDepths::addOutside(const CutPolygon& triangle, bool has_fourth,
                              std::vector<CutPolygon>* pieces) const {
  CutPolygon rest = triangle;
  for (std::size_t f = 0; f < depths_.size(); ++f) {
    if (depths_[f].head<3>().isZero(0.0)) {
      if (has_fourth && depths_[f][3] > 0.0) continue;
      pieces->push_back(std::move(rest));
      return;
    }
    CutPolygon before = clip(rest, f, false);
    if (!before.vertices.empty()) pieces->push_back(std::move(before));
    rest = clip(rest, f, true);
    if (rest.vertices.empty()) return;
  }
}

CutPolygon CornerDepths::section(std::size_t face) const {
  const Eigen::Vector4d& depth = depths_[face];
  CutPolygon polygon;
  if (depth.minCoeff() >= 0.0) return polygon;
  std::vector<int> before, on, beyond;
  for (int k = 0; k < 4; ++k) {
    (depth[k] < 0.0 ? before : depth[k] > 0.0 ? beyond : on).push_back(k);
  }
  for (const int k : on) polygon.vertices.emplace_back(Eigen::Vector4d::Unit(k));
  const auto cross = [&](int a, int b) {
    const double part = depth[a] / (depth[a] - depth[b]);
    polygon.vertices.emplace_back((1.0 - part) * Eigen::Vector4d::Unit(a) +
                                  part * Eigen::Vector4d::Unit(b));
  };
  // Two corners before and two behind give a quadrangle, whose corners are put in cyclic order.
  for (std::size_t i = 0; i < before.size(); ++i) {
    for (std::size_t j = 0; j < beyond.size(); ++j) {
      cross(before[i], beyond[i % 2 == 0 ? j : beyond.size() - 1 - j]);
    }
  }
  if (polygon.vertices.size() < 3) polygon.vertices.clear();
  for (std::size_t f = 0; f < depths_.size() && !polygon.vertices.empty(); ++f) {
    if (f != face) polygon = clip(polygon, f, true);
  }
  return polygon;
}

}  // namespace palpate::mesh
