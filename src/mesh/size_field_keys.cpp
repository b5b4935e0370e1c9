// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/size_field_keys.h"

#include <optional>
#include <string>

#include "palpate/mesh/selection_keys.h"

namespace palpate::mesh {

void describe(keys::FieldVisitor& v, FinePlace& place) {
  v.number({"finest", "m", "Length of the edges there.", keys::Need::kRequired}, place.finest,
           edgeLengthRange());
  v.number({"radius", "m", "Edges begin to grow at this distance from the place."}, place.radius,
           keys::Range::closed(0.0, 100.0));
  v.number({"growth", "", "Beyond it an edge grows by this for each metre farther away."},
           place.growth, keys::Range::above(0.0, 1.0));
  std::optional<Vec3> point;
  Polyline line;
  Region region;
  bool surface = false;
  const bool has_point =
      v.vector3({"point", "m", "The place is a point."}, point, keys::coordinateRange());
  const bool has_path =
      v.vectors3({"path", "m", "The place is the line through these points, as of a tool's way."},
                 line.points, keys::coordinateRange(), 1);
  const bool has_region = v.section({"region", "", "The place is a region."}, region);
  v.flag({"surface", "", "The place is the organ's own surface."}, surface);
  v.rule(has_point + has_path + has_region + surface == 1, "",
         "needs exactly one of point, path, region, surface");
  if (has_point && point) line.points = {*point};
  if (has_region) {
    place.where = region;
  } else if (surface) {
    place.where = OwnSurface{};
  } else {
    place.where = line;
  }
}

void describe(keys::FieldVisitor& v, SizeField& field) {
  v.number({"coarsest", "m", "Length of the edges far from all places in `near`."}, field.coarsest,
           edgeLengthRange());
  v.list({"near", "",
          "Places where edges are shorter; coordinates in the organ's own frame, after scaling. "
          "Where several reach, the shortest edge holds."},
         field.near, 0);
  const std::string rule = "finest must be at most the coarsest of the organ";
  v.rule(true, "near[].finest", rule);
  for (std::size_t i = 0; i < field.near.size(); ++i) {
    const bool fine = field.near[i].finest <= field.coarsest;
    if (!fine) v.rule(false, "near[" + std::to_string(i) + "].finest", rule);
  }
}

}  // namespace palpate::mesh
