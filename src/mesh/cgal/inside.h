// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/mesh/surface_mesh.h"

namespace palpate::mesh::cgal {

/// Which points are inside of a closed surface, told exactly.
class Inside {
 public:
  /// `surface` is closed and does not cut itself.
  explicit Inside(const SurfaceMesh& surface);
  ~Inside();
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;

  /// A point of the surface itself counts as inside.
  bool contains(const Vec3& p) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate::mesh::cgal
