// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/scene/edge_length_config.h"

#include <optional>
#include <string>
#include <variant>

#include "palpate/mesh/selection_keys.h"

namespace palpate::scene {

void describe(keys::FieldVisitor& v, RefinementZoneConfig& place) {
  v.number({"finest", "m", "Length of the edges there.", keys::Need::kRequired}, place.finest,
           edgeLengthRange());
  v.number({"radius", "m", "Edges begin to grow at this distance from the place."}, place.radius,
           keys::Range::closed(0.0, 100.0));
  v.number({"growth", "", "Beyond it an edge grows by this for each metre farther away."},
           place.growth, keys::Range::above(0.0, 1.0));
  std::optional<Vec3> point;
  mesh::Polyline line;
  std::optional<mesh::Region> region;
  bool surface = std::holds_alternative<mesh::OwnSurface>(place.where);
  if (const auto* present = std::get_if<mesh::Polyline>(&place.where)) line = *present;
  if (line.points.size() == 1) {
    point = line.points.front();
    line.points.clear();
  }
  if (const auto* present = std::get_if<mesh::Region>(&place.where)) region = *present;
  const bool has_point =
      v.vector3({"point", "m", "The place is a point."}, point, keys::coordinateRange());
  const bool has_path =
      v.vectors3({"path", "m", "The place is the line through these points, as of a tool's way."},
                 line.points, keys::coordinateRange(), 1);
  const bool has_region = v.section({"region", "", "The place is a region."}, region);
  v.flag({"surface", "", "The place is the organ's own surface."}, surface);
  const bool has_trajectory =
      v.text({"trajectory", "",
              "The place is the way of a tool's control frame along this table of joint positions, "
              "as `palpate replay` takes it; a path as for `surface`."},
             place.trajectory);
  v.onlyIf(has_trajectory, "`trajectory`", [&] {
    v.text({"instrument", "", "Name of the tool; needed where the scene has several."},
           place.instrument);
  });
  v.rule(has_point + has_path + has_region + surface + has_trajectory == 1, "",
         "needs exactly one of point, path, region, surface, trajectory");
  if (has_point && point) line.points = {*point};
  if (has_region) {
    place.where = *region;
  } else if (surface) {
    place.where = mesh::OwnSurface{};
  } else if (has_point || has_path) {
    place.where = line;
  }
}

void describe(keys::FieldVisitor& v, EdgeLengthConfig& edge_length) {
  v.number({"coarsest", "m", "Length of the edges far from all places in `near`."},
           edge_length.coarsest, edgeLengthRange());
  v.list({"near", "",
          "Places where edges are shorter; coordinates in the organ's own frame, after scaling. "
          "Where several reach, the shortest edge holds."},
         edge_length.near, 0);
  const std::string rule = "finest must be at most the coarsest of the organ";
  v.rule(true, "near[].finest", rule);
  for (std::size_t i = 0; i < edge_length.near.size(); ++i) {
    const bool fine = edge_length.near[i].finest <= edge_length.coarsest;
    if (!fine) v.rule(false, "near[" + std::to_string(i) + "].finest", rule);
  }
}

}  // namespace palpate::scene
