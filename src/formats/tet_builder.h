// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::formats {

/// Nodes of a tetrahedron in VTK order, counted from 0 in the order of addPoint(). Only 10-node
/// ones use the last six.
using TetNodes = std::array<std::int64_t, 10>;

/// Collects the points, tetrahedra and problems of a file, for all formats alike.
class TetBuilder {
 public:
  explicit TetBuilder(std::string file) : file_(std::move(file)) {}

  std::size_t numPoints() const { return points_.size(); }
  std::size_t numTets() const { return tets_.size(); }
  void addPoint(const Vec3& point) { points_.push_back(point); }
  /// `num_nodes` is 4 or 10. finish() checks the indices.
  void addTet(const TetNodes& nodes, int num_nodes);
  /// Sets the region of the last tetrahedron; either all have one or none.
  void setRegion(int region);
  /// Sets cell data of the last tetrahedron: `components` numbers.
  /// @throws InputError if the name had another number of components before.
  void setData(const std::string& name, int components, const double* values);

  /// Drops unused points, reverses the tetrahedra if all are inverted, checks everything.
  /// @throws InputError with all problems of the first kind found.
  mesh::TetMesh finish();

 private:
  void checkNodes() const;
  void checkPoints() const;
  void checkDoubles() const;

  std::string file_;
  std::vector<Vec3> points_;
  std::vector<TetNodes> tets_;
  std::vector<int> region_;
  struct Data {
    int components = 0;
    std::vector<double> values;  // up to the last tetrahedron with values
  };
  std::map<std::string, Data> data_;
  std::size_t num_quadratic_ = 0;
};

}  // namespace palpate::formats
