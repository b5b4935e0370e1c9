// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/selection_keys.h"

#include <cmath>
#include <optional>
#include <variant>

namespace palpate::mesh {
namespace {

// The region as a T, if it is one.
template <class T, class Any>
std::optional<T> regionAs(const Any& region) {
  const T* is = std::get_if<T>(&region);
  return is ? std::optional<T>(*is) : std::nullopt;
}

}  // namespace

void describe(keys::FieldVisitor& v, PlaneRegion& plane) {
  const std::vector<std::string> axes = {"x", "y", "z"};
  std::string axis = axes[static_cast<std::size_t>(plane.axis)];
  v.choice({"axis", "", "Normal of the plane.", keys::Need::kRequired}, axis, axes);
  for (int i = 0; i < 3; ++i) {
    if (axis == axes[static_cast<std::size_t>(i)]) plane.axis = i;
  }
  v.number({"at", "m", "Coordinate along the axis.", keys::Need::kRequired}, plane.at,
           keys::coordinateRange());
  std::optional<double> tolerance;
  if (plane.tolerance >= 0.0) tolerance = plane.tolerance;
  v.number({"tolerance", "m",
            "Points as far from the plane still count; by default 1e-9 of the diagonal of the "
            "bounding box."},
           tolerance, keys::Range::closed(0.0, 100.0));
  if (tolerance) plane.tolerance = *tolerance;
}

void describe(keys::FieldVisitor& v, BoxRegion& box) {
  v.vector3({"min", "m", "Lowest corner.", keys::Need::kRequired}, box.min,
            keys::coordinateRange());
  v.vector3({"max", "m", "Highest corner.", keys::Need::kRequired}, box.max,
            keys::coordinateRange());
  v.rule((box.min.array() <= box.max.array()).all(), "min", "min must be <= max in x, y and z");
}

void describe(keys::FieldVisitor& v, SphereRegion& sphere) {
  v.vector3({"center", "m", "Centre.", keys::Need::kRequired}, sphere.center,
            keys::coordinateRange());
  v.number({"radius", "m", "Points within it count.", keys::Need::kRequired}, sphere.radius,
           keys::Range::above(0.0, 100.0));
}

void describe(keys::FieldVisitor& v, Region& region) {
  auto plane = regionAs<PlaneRegion>(region);
  auto box = regionAs<BoxRegion>(region);
  auto sphere = regionAs<SphereRegion>(region);
  const bool has_plane = v.section({"plane", "", "All points of a plane."}, plane);
  const bool has_box = v.section({"box", "", "All points in a box."}, box);
  const bool has_sphere = v.section({"sphere", "", "All points in a ball."}, sphere);
  v.rule(has_plane + has_box + has_sphere == 1, "", "needs exactly one of plane, box, sphere");
  if (has_plane) region = *plane;
  if (has_box) region = *box;
  if (has_sphere) region = *sphere;
}

void describe(keys::FieldVisitor& v, HalfSpaceRegion& half_space) {
  v.vector3({"point", "m", "A point of its plane.", keys::Need::kRequired}, half_space.point,
            keys::coordinateRange());
  v.vector3({"normal", "", "Into the half space, of any length but zero.", keys::Need::kRequired},
            half_space.normal, keys::Range::closed(-1.0e6, 1.0e6));
  v.rule(half_space.normal.norm() > 1.0e-9, "normal", "the normal must not be zero");
}

void describe(keys::FieldVisitor& v, CellDataRegion& cell_data) {
  v.text({"name", "",
          "Cell data of a .vtk or .vtu mesh, whole numbers; by default the tags: Gmsh's physical "
          "groups, Medit's references, VTK's `region` or `gmsh:physical`."},
         cell_data.name);
  v.integer({"value", "", "Tetrahedra with this value.", keys::Need::kRequired}, cell_data.value,
            keys::Range::closed(-2.0e9, 2.0e9));
}

void describe(keys::FieldVisitor& v, DepthRegion& depth) {
  bool any = v.number({"min", "m", "Least distance of the centroid from the body's surface."},
                      depth.min, keys::Range::closed(0.0, 100.0));
  std::optional<double> max;
  if (std::isfinite(depth.max)) max = depth.max;
  any |= v.number({"max", "m", "Largest distance; by default none."}, max,
                  keys::Range::above(0.0, 100.0));
  if (max) depth.max = *max;
  v.rule(any && depth.min <= depth.max, "", "needs min, max or both, min <= max");
}

void describe(keys::FieldVisitor& v, TetRegion& region) {
  auto box = regionAs<BoxRegion>(region);
  auto sphere = regionAs<SphereRegion>(region);
  auto half_space = regionAs<HalfSpaceRegion>(region);
  auto cell_data = regionAs<CellDataRegion>(region);
  auto depth = regionAs<DepthRegion>(region);
  const bool has_box = v.section({"box", "", "In a box."}, box);
  const bool has_sphere = v.section({"sphere", "", "In a ball."}, sphere);
  const bool has_half = v.section({"half_space", "", "On one side of a plane."}, half_space);
  const bool has_data = v.section({"cell_data", "", "By what the mesh file says."}, cell_data);
  const bool has_depth =
      v.section({"depth", "", "By the distance from the body's surface: a capsule."}, depth);
  v.rule(has_box + has_sphere + has_half + has_data + has_depth == 1, "",
         "needs exactly one of box, sphere, half_space, cell_data, depth");
  if (has_box) region = *box;
  if (has_sphere) region = *sphere;
  if (has_half) region = *half_space;
  if (has_data) region = *cell_data;
  if (has_depth) region = *depth;
}

}  // namespace palpate::mesh
