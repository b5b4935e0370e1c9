// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/mesh/surface_mesh.h"

namespace palpate::mesh::cgal {

/// Exact test whether points are inside a closed surface.
class Inside {
 public:
  /// @pre `surface` is closed, without self-intersection.
  explicit Inside(const SurfaceMesh& surface);
  ~Inside();
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;

  /// True also for points of the surface.
  bool contains(const Vec3& p) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate::mesh::cgal
