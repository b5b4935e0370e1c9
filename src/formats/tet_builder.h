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

/// Nodes of one tetrahedron in VTK order, counted from 0 in the order of addPoint(); the last six
/// are used by 10-node ones only.
using TetNodes = std::array<std::int64_t, 10>;

/// Collects the points and tetrahedra of a file and everything that is wrong with them, the same
/// way for every format.
class TetBuilder {
 public:
  explicit TetBuilder(std::string file) : file_(std::move(file)) {}

  std::size_t numPoints() const { return points_.size(); }
  std::size_t numTets() const { return tets_.size(); }
  void addPoint(const Vec3& point) { points_.push_back(point); }
  /// `num_nodes` is 4 or 10. Indices out of range are found by finish().
  void addTet(const TetNodes& nodes, int num_nodes);
  /// Of the tetrahedron added last; either all have one or none has.
  void setRegion(int region);
  /// Cell data of the tetrahedron added last: `components` numbers.
  /// @throws InputError if the name had another number of components before.
  void setData(const std::string& name, int components, const double* values);

  /// Drops unused points, turns the tetrahedra if all are inverted, checks everything.
  /// @throws InputError with all problems of the first kind that is found.
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
    std::vector<double> values;  // up to the last tetrahedron that has any
  };
  std::map<std::string, Data> data_;
  std::size_t num_quadratic_ = 0;
};

}  // namespace palpate::formats
