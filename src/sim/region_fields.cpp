// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/sim/scene_fields.h"

namespace palpate::sim {

Range coordinateRange() { return Range::closed(-100.0, 100.0); }

void describe(FieldVisitor& v, mesh::PlaneRegion& plane) {
  const std::vector<std::string> axes = {"x", "y", "z"};
  std::string axis;
  v.choice({"axis", "", "Normal of the plane.", Need::kRequired}, axis, axes);
  for (int i = 0; i < 3; ++i) {
    if (axis == axes[static_cast<std::size_t>(i)]) plane.axis = i;
  }
  v.number({"at", "m", "Coordinate along the axis.", Need::kRequired}, plane.at, coordinateRange());
  std::optional<double> tolerance;
  v.number({"tolerance", "m",
            "Points as far from the plane still count; by default 1e-9 of the diagonal of the "
            "bounding box."},
           tolerance, Range::closed(0.0, 100.0));
  if (tolerance) plane.tolerance = *tolerance;
}

void describe(FieldVisitor& v, mesh::BoxRegion& box) {
  v.vector3({"min", "m", "Lowest corner.", Need::kRequired}, box.min, coordinateRange());
  v.vector3({"max", "m", "Highest corner.", Need::kRequired}, box.max, coordinateRange());
  v.rule((box.min.array() <= box.max.array()).all(), "min", "min must be <= max in x, y and z");
}

void describe(FieldVisitor& v, mesh::SphereRegion& sphere) {
  v.vector3({"center", "m", "Centre.", Need::kRequired}, sphere.center, coordinateRange());
  v.number({"radius", "m", "Points within it count.", Need::kRequired}, sphere.radius,
           Range::above(0.0, 100.0));
}

void describe(FieldVisitor& v, mesh::Region& region) {
  mesh::PlaneRegion plane;
  mesh::BoxRegion box;
  mesh::SphereRegion sphere;
  const bool has_plane = v.section({"plane", "", "All points of a plane."}, plane);
  const bool has_box = v.section({"box", "", "All points in a box."}, box);
  const bool has_sphere = v.section({"sphere", "", "All points in a ball."}, sphere);
  v.rule(has_plane + has_box + has_sphere == 1, "", "needs exactly one of plane, box, sphere");
  if (has_plane) region = plane;
  if (has_box) region = box;
  if (has_sphere) region = sphere;
}

}  // namespace palpate::sim
