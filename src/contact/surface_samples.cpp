// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/surface_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace palpate::contact {
namespace {

/// An edge of the surface, from its lower to its higher node.
struct Edge {
  int divisions;
  int first = -1;  ///< Of its divisions - 1 samples between the nodes, which follow one another.
};

class Sampler {
 public:
  Sampler(const Points& X, const Eigen::Matrix3Xi& triangles, double spacing)
      : X_(X), spacing_(spacing), at_node_(static_cast<std::size_t>(X.cols()), -1) {
    edge_number_.reserve(static_cast<std::size_t>(2 * triangles.cols()));
    for (Eigen::Index t = 0; t < triangles.cols(); ++t) add(triangles.col(t));
  }
  std::vector<SurfaceSample> take() { return std::move(samples_); }

 private:
  void add(const Eigen::Vector3i& nodes) {
    std::array<int, 3> edge;  // the k-th is opposite corner k
    int n = 1;
    for (int k = 0; k < 3; ++k) {
      edge[k] = edgeBetween(nodes[(k + 1) % 3], nodes[(k + 2) % 3]);
      n = std::max(n, edges_[edge[k]].divisions);
    }
    for (int k = 0; k < 3; ++k) {
      if (at_node_[nodes[k]] >= 0) continue;
      at_node_[nodes[k]] = static_cast<int>(samples_.size());
      samples_.push_back({nodes, Vec3::Unit(k), 0.0});
    }
    for (int k = 0; k < 3; ++k) addBetween(nodes, (k + 1) % 3, (k + 2) % 3, &edges_[edge[k]]);

    const Vec3 a = X_.col(nodes[0]);
    const double area =
        0.5 * (X_.col(nodes[1]) - a).cross(Vec3(X_.col(nodes[2])) - a).norm() / (n * n);
    // The triangle in n^2 small ones, each of which gives a third of its area to its corners: six
    // of them meet inside, three on an edge, one at a corner.
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) {
        const std::array<int, 3> at{i, j, n - i - j};
        const auto zeros = std::count(at.begin(), at.end(), 0);
        if (zeros == 0) {
          samples_.push_back({nodes, Vec3(i, j, at[2]) / n, 2.0 * area});
        } else if (zeros == 2) {
          const auto corner = std::find(at.begin(), at.end(), n) - at.begin();
          samples_[at_node_[nodes[corner]]].area += area / 3.0;
        } else {
          const int k = static_cast<int>(std::find(at.begin(), at.end(), 0) - at.begin());
          share(area, nodes[(k + 1) % 3], nodes[(k + 2) % 3], edges_[edge[k]],
                static_cast<double>(at[(k + 2) % 3]) / n);
        }
      }
    }
  }

  int edgeBetween(int a, int b) {
    const auto [low, high] = std::minmax(a, b);
    const auto key = static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high);
    const auto [at, fresh] = edge_number_.emplace(key, static_cast<int>(edges_.size()));
    if (fresh) edges_.push_back({sampleDivisions((X_.col(high) - X_.col(low)).norm(), spacing_)});
    return at->second;
  }

  // The samples of an edge between the corners `from` and `to`, if it has none yet.
  void addBetween(const Eigen::Vector3i& nodes, int from, int to, Edge* edge) {
    if (edge->first >= 0) return;
    if (nodes[from] > nodes[to]) std::swap(from, to);
    edge->first = static_cast<int>(samples_.size());
    for (int m = 1; m < edge->divisions; ++m) {
      Vec3 weights = Vec3::Zero();
      weights[to] = static_cast<double>(m) / edge->divisions;
      weights[from] = 1.0 - weights[to];
      samples_.push_back({nodes, weights, 0.0});
    }
  }

  // Gives `area` to the samples around the point at part `s` of the way from node a to b, nearer
  // ones more.
  void share(double area, int a, int b, const Edge& edge, double s) {
    if (a > b) {
      std::swap(a, b);
      s = 1.0 - s;
    }
    const auto sampleAt = [&](int m) {
      if (m == 0) return at_node_[a];
      return m == edge.divisions ? at_node_[b] : edge.first + m - 1;
    };
    const double place = s * edge.divisions;
    const int before = std::min(static_cast<int>(place), edge.divisions - 1);
    samples_[sampleAt(before)].area += (1.0 - (place - before)) * area;
    samples_[sampleAt(before + 1)].area += (place - before) * area;
  }

  const Points& X_;
  double spacing_;
  std::vector<SurfaceSample> samples_;
  std::vector<int> at_node_;
  std::vector<Edge> edges_;
  std::unordered_map<std::uint64_t, int> edge_number_;
};

}  // namespace

int sampleDivisions(double length, double spacing) {
  if (!(spacing > 0.0)) return 1;
  return static_cast<int>(
      std::clamp(std::ceil(length / spacing), double{kLeastDivisions}, double{kMaxDivisions}));
}

std::vector<SurfaceSample> sampleSurface(const Points& X, const Eigen::Matrix3Xi& triangles,
                                         double spacing) {
  return Sampler(X, triangles, spacing).take();
}

}  // namespace palpate::contact
