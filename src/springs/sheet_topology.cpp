// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/sheet_topology.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "palpate/springs/lumped_mass.h"

namespace palpate::springs {
namespace {

using Ends = std::pair<int, int>;

Ends sorted(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

// Corners opposite each edge. Consistent neighbours traverse their edge in opposite directions.
std::map<Ends, std::vector<int>> oppositeCorners(const Eigen::Matrix3Xi& triangles) {
  std::map<Ends, std::vector<int>> edges;
  std::set<Ends> directed;
  for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Ends ends = sorted(triangles(k, t), triangles((k + 1) % 3, t));
      std::vector<int>& opposite = edges[ends];
      opposite.push_back(triangles((k + 2) % 3, t));
      if (opposite.size() > 2) {
        throw std::invalid_argument("triangle " + std::to_string(t) + ": its edge from point " +
                                    std::to_string(ends.first) + " to " +
                                    std::to_string(ends.second) + " has two triangles already");
      }
      if (!directed.emplace(triangles(k, t), triangles((k + 1) % 3, t)).second) {
        throw std::invalid_argument("triangle " + std::to_string(t) +
                                    ": turns the other way than its neighbour, or is there twice");
      }
    }
  }
  return edges;
}

}  // namespace

SheetTopology sheetTopology(const Points& points, const Eigen::Matrix3Xi& triangles) {
  const Eigen::VectorXd areas = triangleShares(points, triangles);
  for (Eigen::Index i = 0; i < areas.size(); ++i) {
    if (areas[i] == 0.0) {
      throw std::invalid_argument("point " + std::to_string(i) + ": is in no triangle");
    }
  }
  const std::map<Ends, std::vector<int>> edges = oppositeCorners(triangles);
  std::set<Ends> flexion;
  std::set<int> boundary;
  for (const auto& [ends, opposite] : edges) {
    if (opposite.size() == 1) {
      boundary.insert({ends.first, ends.second});
    } else if (opposite[0] != opposite[1]) {
      const Ends pair = sorted(opposite[0], opposite[1]);
      if (!edges.count(pair)) flexion.insert(pair);
    }
  }
  std::vector<int> valence(static_cast<std::size_t>(points.cols()), 0);
  for (Eigen::Index i = 0; i < triangles.size(); ++i) {
    ++valence[static_cast<std::size_t>(triangles.data()[i])];
  }
  const auto inner = [&](int wanted) {
    int count = 0;
    for (std::size_t i = 0; i < valence.size(); ++i) {
      count += valence[i] == wanted && !boundary.count(static_cast<int>(i));
    }
    return count;
  };
  SheetTopology sheet;
  const auto add = [&](const Ends& ends, SpringKind kind) {
    const double length = (points.col(ends.second) - points.col(ends.first)).norm();
    sheet.springs.push_back({ends.first, ends.second, 0.0, 0.0, 0.0, length, kind});
  };
  for (const auto& edge : edges) add(edge.first, SpringKind::kStructural);
  for (const Ends& ends : flexion) add(ends, SpringKind::kFlexion);
  sheet.counts = {static_cast<int>(triangles.cols()),
                  static_cast<int>(points.cols()),
                  static_cast<int>(boundary.size()),
                  inner(3),
                  inner(4),
                  static_cast<int>(sheet.springs.size())};
  return sheet;
}

}  // namespace palpate::springs
