// SPDX-License-Identifier: GPL-3.0-or-later
#include "inside.h"

#include <CGAL/Side_of_triangle_mesh.h>

#include "convert.h"

namespace palpate::mesh::cgal {

struct Inside::Impl {
  explicit Impl(const SurfaceMesh& surface) : mesh(toMesh<Mesh>(toSoup(surface))), side(mesh) {}

  const Mesh mesh;  // referenced by `side`
  const CGAL::Side_of_triangle_mesh<Mesh, Kernel> side;
};

Inside::Inside(const SurfaceMesh& surface) : impl_(std::make_unique<Impl>(surface)) {}
Inside::~Inside() = default;

bool Inside::contains(const Vec3& p) const {
  return impl_->side(Point(p[0], p[1], p[2])) != CGAL::ON_UNBOUNDED_SIDE;
}

}  // namespace palpate::mesh::cgal
