// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "palpate/mesh/mesh_change.h"

namespace palpate::fem {

/// What becomes of values at the integration points of a body when its mesh changes. Those of an
/// element are a constant, or with four points a linear field. Parts of an element have that field;
/// an element of several parts has, of all constants or linear fields, the nearest to theirs in the
/// mean square. So the integral over the body stays, what was split and is joined again is what it
/// was, and no mean square grows.
class PointChange {
 public:
  /// A point of the old mesh, and its part in a value.
  struct Source {
    int element, point;
    double weight;
  };
  struct Sources {
    const Source *first, *last;
    const Source* begin() const { return first; }
    const Source* end() const { return last; }
    /// The value is that of the one source, to the bit.
    bool isCopy() const { return last == first + 1; }
  };

  /// `old_volumes` of the old elements.
  /// @throws std::invalid_argument if the change is not one of elements with so many points.
  PointChange(const mesh::MeshChange& change, int points_per_element,
              const std::vector<double>& old_volumes);

  /// Of the value at point `q` of new element `e`, which is the sum of theirs.
  Sources sources(int e, int q) const {
    const std::size_t i = static_cast<std::size_t>(e) * points_per_element_ + q;
    return {sources_.data() + begin_[i], sources_.data() + begin_[i + 1]};
  }

 private:
  void addConstants(const mesh::MeshChange& change, const std::vector<double>& old_volumes);
  void addLinearFields(const mesh::MeshChange& change, const std::vector<double>& old_volumes);

  int points_per_element_;
  std::vector<Source> sources_;
  std::vector<std::size_t> begin_ = {0};  // of each point, and the end
};

}  // namespace palpate::fem
