// SPDX-License-Identifier: GPL-3.0-or-later
#include "make_bem.h"

#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "bem_organ.h"
#include "tissue/model_library.h"

namespace palpate::tissue {
namespace {

void refuse(const OrganDescription& organ, const fem::Composition& composition,
            const ModelSettings& settings) {
  if (organ.adapt.on()) {
    throw std::invalid_argument("adapt: the surface of model bem stays; leave adapt out");
  }
  if (!composition.frames.empty()) {
    throw std::invalid_argument(
        "model bem is the same in all directions; choose a law without fibres");
  }
  if (!composition.solids.front().prony.empty()) {
    throw std::invalid_argument("model bem has no viscous memory; leave viscoelastic out");
  }
  if (settings.needles) {
    throw std::invalid_argument(
        "model bem knows no needle that goes in; leave the instruments' needle out");
  }
}

// Counts connected components of the surface that enclose a volume; the others are cavities.
int countBodies(const mesh::SurfaceMesh& surface) {
  std::vector<int> root(static_cast<std::size_t>(surface.points.cols()));
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int i) {
    while (root[static_cast<std::size_t>(i)] != i) i = root[static_cast<std::size_t>(i)];
    return i;
  };
  for (const auto& t : surface.triangles.colwise()) {
    for (int k = 1; k < 3; ++k) root[static_cast<std::size_t>(find(t[k]))] = find(t[0]);
  }
  std::vector<double> volumes(root.size(), 0.0);
  const Points& X = surface.points;
  for (const auto& t : surface.triangles.colwise()) {
    volumes[static_cast<std::size_t>(find(t[0]))] +=
        X.col(t[0]).dot(Vec3(X.col(t[1])).cross(Vec3(X.col(t[2]))));
  }
  int bodies = 0;
  for (const double volume : volumes) bodies += volume > 0.0;
  return bodies;
}

}  // namespace

std::unique_ptr<TissueModel> makeBem(const ModelDescription& description) {
  const OrganDescription& organ = description.organs.front();
  const fem::Composition composition = organ.composition({});
  refuse(organ, composition, description.settings);
  BemParts parts;
  parts.surface = organ.surface_elements();
  parts.free = organ.free(parts.surface.points);
  Points& X = parts.surface.points;
  if (const int bodies = countBodies(parts.surface); bodies != 1) {
    throw std::invalid_argument("the surface encloses " + std::to_string(bodies) +
                                " bodies, and model bem is of one; make an organ of each");
  }
  X = (organ.X_WO * X.colwise().homogeneous()).eval();
  const std::string motions = fem::freeRigidMotions(X, parts.free);
  if (!motions.empty()) {
    throw std::invalid_argument("model bem needs an organ that its supports hold, they leave " +
                                motions);
  }
  const material::Solid& solid = composition.solids.front();
  parts.moduli = material::moduli(solid.law);
  parts.density = solid.density;
  return std::make_unique<BemOrgan>(parts, description.settings, description.pool);
}

}  // namespace palpate::tissue

PALPATE_TISSUE_MODEL(bem, palpate::tissue::makeBem)
