// SPDX-License-Identifier: GPL-3.0-or-later
#include "support_kinds.h"

#include <Eigen/Geometry>
#include <stdexcept>

namespace palpate::scene {
namespace {

// Slide stiffness over E/size [-].
constexpr double kSlide = 1000.0;
// Largest sine of the angle between normals and axis for a plane.
constexpr double kPlane = 1e-9;

void addGlue(const SelectedSupport& place, tissue::Surroundings* surroundings) {
  for (const int i : place.nodes) surroundings->free.col(i).setZero();
  if (place.motion) surroundings->carried.push_back({place.nodes, *place.motion});
}

// World axis normal to all faces, or -1.
int axisAcross(const SelectedSupport& place) {
  Vec3 largest = Vec3::Zero();  // of the unit normals, by component
  for (Eigen::Index t = 0; t < place.faces.cols(); ++t) {
    const Vec3 a = place.points.col(place.faces(0, t)), b = place.points.col(place.faces(1, t));
    const Vec3 c = place.points.col(place.faces(2, t));
    largest = largest.cwiseMax((b - a).cross(c - a).normalized().cwiseAbs());
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (largest[(axis + 1) % 3] <= kPlane && largest[(axis + 2) % 3] <= kPlane) return axis;
  }
  return -1;
}

void addSlide(const SelectedSupport& place, tissue::Surroundings* surroundings) {
  const int axis = axisAcross(place);
  if (axis >= 0) {
    for (const int i : place.faces.reshaped()) surroundings->free(axis, i) = 0.0;
    return;
  }
  const Vec3 extent = place.points.rowwise().maxCoeff() - place.points.rowwise().minCoeff();
  fem::FoundationConstants constants;
  constants.normal =
      place.config.stiffness.value_or(slideStiffness(place.young_modulus, extent.norm()));
  surroundings->springs.push_back({place.nodes, constants, std::nullopt});
}

void addSprings(const SelectedSupport& place, tissue::Surroundings* surroundings) {
  surroundings->springs.push_back({place.nodes, place.config.springs, place.motion});
}

// All kinds, the default first. To add one: its function, an entry here, its keys in
// surroundings_fields.cpp.
constexpr SupportKind kKinds[] = {
    {"glue", false, addGlue}, {"slide", true, addSlide}, {"springs", true, addSprings}};

}  // namespace

std::vector<std::string> supportKindNames() {
  std::vector<std::string> names;
  for (const SupportKind& kind : kKinds) names.emplace_back(kind.name);
  return names;
}

const SupportKind& supportKind(const std::string& name) {
  for (const SupportKind& kind : kKinds) {
    if (name == kind.name) return kind;
  }
  throw std::logic_error("no kind of support: " + name);
}

double slideStiffness(double young_modulus, double size) { return kSlide * young_modulus / size; }

}  // namespace palpate::scene
