// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "palpate/mesh/mesh_change.h"

namespace palpate::fem {

/// Transfer of values at integration points to a changed mesh. Values of an element are a constant,
/// or with four points a linear field. Parts of an element keep its field; a union gets the nearest
/// constant or linear field in the mean square. So the integral over the body is preserved,
/// splitting and joining restores the values, and no mean square grows.
class PointChange {
 public:
  /// A point of the old mesh and its weight.
  struct Source {
    int element, point;
    double weight;
  };
  struct Sources {
    const Source *first, *last;
    const Source* begin() const { return first; }
    const Source* end() const { return last; }
    /// Whether the value is a bitwise copy of a single source.
    bool isCopy() const { return last == first + 1; }
  };

  /// `old_volumes`: volumes of the old elements.
  /// @throws std::invalid_argument for a change of elements with another number of points.
  PointChange(const mesh::MeshChange& change, int points_per_element,
              const std::vector<double>& old_volumes);

  /// Weighted sources of the value at point `q` of new element `e`.
  Sources sources(int e, int q) const {
    const std::size_t i = static_cast<std::size_t>(e) * points_per_element_ + q;
    return {sources_.data() + begin_[i], sources_.data() + begin_[i + 1]};
  }

 private:
  void addConstants(const mesh::MeshChange& change, const std::vector<double>& old_volumes);
  void addLinearFields(const mesh::MeshChange& change, const std::vector<double>& old_volumes);

  int points_per_element_;
  std::vector<Source> sources_;
  std::vector<std::size_t> begin_ = {0};  // first source of each point, and the end
};

}  // namespace palpate::fem
