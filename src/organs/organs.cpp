// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/organs/organs.h"

#include <algorithm>
#include <sstream>

#include "organ_shapes.h"
#include "palpate/base/error.h"

namespace palpate::organs {
namespace {

struct Organ {
  const char* name;
  mesh::SurfaceMesh (*make)(double edge_length);
  double max_edge;  // [m]
};

// To add an organ: a function in organ_shapes.cpp and an entry here.
constexpr Organ kOrgans[] = {{"liver", makeLiver, 0.03},
                             {"kidney", makeKidney, 0.015},
                             {"gallbladder", makeGallbladder, 0.006},
                             {"gallbladder_hollow", makeHollowGallbladder, 0.005},
                             {"slab", makeSlab, 0.03}};

const Organ& findOrgan(const std::string& name) {
  for (const Organ& organ : kOrgans) {
    if (name == organ.name) return organ;
  }
  const std::string near = nearestName(name, organNames());
  throw InputError("", "organ", name,
                   "must be one of " + joinNames(organNames()) +
                       (near.empty() ? "" : "; did you mean " + near + "?"));
}

}  // namespace

std::vector<std::string> organNames() {
  std::vector<std::string> names;
  for (const Organ& organ : kOrgans) names.emplace_back(organ.name);
  return names;
}

double maxOrganEdge(const std::string& name) { return findOrgan(name).max_edge; }

mesh::SurfaceMesh makeOrgan(const std::string& name, double edge_length) {
  const Organ& organ = findOrgan(name);
  if (!(edge_length >= kMinOrganEdge && edge_length <= organ.max_edge)) {
    std::ostringstream value, allowed;
    value << edge_length;
    allowed << "must be in [" << kMinOrganEdge << ", " << organ.max_edge << "] m for the " << name;
    throw InputError("", "edge_length", value.str(), allowed.str());
  }
  mesh::SurfaceMesh surface = organ.make(edge_length);
  const Vec3 low = surface.points.rowwise().minCoeff(), high = surface.points.rowwise().maxCoeff();
  const Vec3 origin(0.5 * (low.x() + high.x()), 0.5 * (low.y() + high.y()), low.z());
  surface.points.colwise() -= origin;
  return surface;
}

}  // namespace palpate::organs
