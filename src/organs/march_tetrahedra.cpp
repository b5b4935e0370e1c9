// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>
#include <vector>

#include "implicit.h"

namespace palpate::organs {
namespace {

// Kuhn's six tetrahedra of a cell; bit i of a corner's index is its step along axis i.
constexpr int kKuhn[6][4] = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7},
                             {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};

class March {
 public:
  March(const ImplicitBody& body, double spacing) : body_(body), spacing_(spacing) {
    const Vec3 cells = ((body.max - body.min) / spacing).array().ceil();
    n_ = cells.cast<int>().array() + 1;
    values_.reserve(static_cast<std::size_t>(n_.x()) * n_.y() * n_.z());
    for (int k = 0; k < n_.z(); ++k) {
      for (int j = 0; j < n_.y(); ++j) {
        for (int i = 0; i < n_.x(); ++i) values_.push_back(body.value(at(i, j, k)));
      }
    }
  }

  mesh::SurfaceMesh run() {
    for (int k = 0; k + 1 < n_.z(); ++k) {
      for (int j = 0; j + 1 < n_.y(); ++j) {
        for (int i = 0; i + 1 < n_.x(); ++i) cell(i, j, k);
      }
    }
    mesh::SurfaceMesh surface;
    surface.points.resize(3, points_.size());
    for (std::size_t p = 0; p < points_.size(); ++p) surface.points.col(p) = points_[p];
    surface.triangles.resize(3, triangles_.size());
    for (std::size_t t = 0; t < triangles_.size(); ++t) surface.triangles.col(t) = triangles_[t];
    return surface;
  }

 private:
  using Node = long long;

  Vec3 at(int i, int j, int k) const { return body_.min + spacing_ * Vec3(i, j, k); }
  Vec3 at(Node node) const {
    return at(static_cast<int>(node % n_.x()), static_cast<int>(node / n_.x() % n_.y()),
              static_cast<int>(node / n_.x() / n_.y()));
  }
  bool inside(Node node) const { return values_[node] < 0.0; }

  void cell(int i, int j, int k) {
    std::array<Node, 8> corner{};
    int count = 0;
    for (int c = 0; c < 8; ++c) {
      corner[c] = i + (c & 1) + Node{n_.x()} * (j + (c >> 1 & 1) + Node{n_.y()} * (k + (c >> 2)));
      count += inside(corner[c]);
    }
    if (count == 0 || count == 8) return;
    for (const auto& path : kKuhn) {
      tetrahedron({corner[path[0]], corner[path[1]], corner[path[2]], corner[path[3]]});
    }
  }

  void tetrahedron(const std::array<Node, 4>& t) {
    std::vector<Node> in, out;
    for (const Node node : t) (inside(node) ? in : out).push_back(node);
    if (in.empty() || out.empty()) return;
    const Vec3 outward = at(out[0]) - at(in[0]);
    if (in.size() == 2) {
      const int a = cut(in[0], out[0]), b = cut(in[0], out[1]), c = cut(in[1], out[1]),
                d = cut(in[1], out[0]);
      add(a, b, c, outward);
      add(a, c, d, outward);
    } else {
      const bool one_in = in.size() == 1;
      const Node apex = one_in ? in[0] : out[0];
      const std::vector<Node>& base = one_in ? out : in;
      add(cut(apex, base[0]), cut(apex, base[1]), cut(apex, base[2]), outward);
    }
  }

  /// Point of the surface on an edge, kept away from its ends, so that no triangle degenerates.
  int cut(Node a, Node b) {
    if (a > b) std::swap(a, b);
    const auto [place, fresh] =
        cuts_.emplace(a * static_cast<Node>(values_.size()) + b, static_cast<int>(points_.size()));
    if (fresh) {
      const double t = std::clamp(values_[a] / (values_[a] - values_[b]), 0.1, 0.9);
      points_.push_back(at(a) + t * (at(b) - at(a)));
    }
    return place->second;
  }

  void add(int a, int b, int c, const Vec3& outward) {
    const Vec3 normal = (points_[b] - points_[a]).cross(points_[c] - points_[a]);
    if (normal.dot(outward) < 0.0) std::swap(b, c);
    triangles_.emplace_back(a, b, c);
  }

  const ImplicitBody& body_;
  double spacing_;
  Eigen::Vector3i n_;
  std::vector<double> values_;
  std::unordered_map<Node, int> cuts_;
  std::vector<Vec3> points_;
  std::vector<Eigen::Vector3i> triangles_;
};

}  // namespace

mesh::SurfaceMesh marchTetrahedra(const ImplicitBody& body, double spacing) {
  return March(body, spacing).run();
}

}  // namespace palpate::organs
