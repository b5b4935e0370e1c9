// SPDX-License-Identifier: GPL-3.0-or-later
#include "make_honeycomb.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "honeycomb_organ.h"
#include "palpate/mesh/point_location.h"
#include "tissue/model_library.h"

namespace palpate::tissue {
namespace {

constexpr double kMaxCells = 2.0e5;

void refuse(const OrganDescription& organ, const fem::Composition& composition) {
  if (organ.adapt.on()) {
    throw std::invalid_argument("adapt: the cells of model honeycomb stay; leave adapt out");
  }
  if (!composition.frames.empty()) {
    throw std::invalid_argument("model honeycomb has no fibres; choose a law without them");
  }
  for (const material::Solid& solid : composition.solids) {
    if (!solid.prony.empty()) {
      throw std::invalid_argument("model honeycomb has no viscous memory; leave viscoelastic out");
    }
  }
}

// Of an incompressible solid of the same Young's modulus [Pa].
double shearModulus(const material::Solid& solid) {
  const material::Moduli m = material::moduli(solid.law);
  return 3.0 * m.kappa * m.mu / (3.0 * m.kappa + m.mu);
}

// Grid, cells, and what they are made of, in the organ's frame.
HoneycombParts partsOf(const mesh::TetMesh& mesh, const fem::Composition& composition,
                       double cell_size) {
  const Vec3 low = mesh.points.rowwise().minCoeff();
  const Vec3 extent = mesh.points.rowwise().maxCoeff() - low;
  const Vec3 count = (extent / cell_size).array().round().max(1.0);
  if (!(count.prod() <= kMaxCells)) {
    throw std::invalid_argument("honeycomb.cell_size = " + std::to_string(cell_size) +
                                " m makes more than 200000 cells; choose larger ones");
  }
  const Eigen::Vector3i n = count.cast<int>();
  const Vec3 size = extent.cwiseQuotient(count);
  HoneycombParts parts;
  std::vector<bool> inside;
  for (int k = 0; k < n.z(); ++k) {
    for (int j = 0; j < n.y(); ++j) {
      for (int i = 0; i < n.x(); ++i) {
        const Vec3 centre = low + size.cwiseProduct(Vec3(i + 0.5, j + 0.5, k + 0.5));
        const auto at = mesh::locate(mesh, centre);
        inside.push_back(at.has_value());
        if (!at) continue;
        const material::Solid& solid = composition.solid(at->tet);
        parts.shear_modulus.push_back(shearModulus(solid));
        parts.density.push_back(solid.density);
      }
    }
  }
  if (parts.density.empty()) {
    throw std::invalid_argument("honeycomb.cell_size = " + std::to_string(cell_size) +
                                " m: no cell has its centre in the organ; choose smaller ones");
  }
  parts.lattice = makeCellLattice(low, size, n, inside);
  return parts;
}

// What the supports leave of the corners, from the world's directions to those of the organ.
Eigen::Matrix3Xd freeInOrgan(const OrganDescription& organ, const Points& corners) {
  const fem::FreeMask free = organ.free(corners);
  if (organ.X_WO.linear().isIdentity(1e-12)) return free;
  for (Eigen::Index i = 0; i < free.cols(); ++i) {
    if (free.col(i).minCoeff() != free.col(i).maxCoeff()) {
      throw std::invalid_argument(
          "supports that leave directions free need an organ of model "
          "honeycomb that is not turned");
    }
  }
  return free;
}

// Sides that are joined, whole: each part needs one that is held, or nothing says where it is.
void requireHeld(const CellLattice& lattice, const HeldSides& held) {
  std::vector<bool> seen(lattice.cells.size(), false);
  for (int first = 0; first < lattice.numCells(); ++first) {
    if (seen[static_cast<std::size_t>(first)]) continue;
    bool is_held = false;
    std::vector<int> part{first};
    seen[static_cast<std::size_t>(first)] = true;
    for (std::size_t at = 0; at < part.size(); ++at) {
      for (int k = 0; k < 6; ++k) {
        const auto cell = static_cast<std::size_t>(part[at]);
        const int side = lattice.cells[cell].sides[static_cast<std::size_t>(k)];
        is_held = is_held || held.all[static_cast<std::size_t>(side)];
        const int other = lattice.neighbour(part[at], k);
        if (other < 0 || seen[static_cast<std::size_t>(other)]) continue;
        seen[static_cast<std::size_t>(other)] = true;
        part.push_back(other);
      }
    }
    if (is_held) continue;
    throw std::invalid_argument(
        "supports: model honeycomb is quasi-static; each part of its cells needs a side of which "
        "all corners are glued, and the one around cell " +
        std::to_string(first) + ", of " + std::to_string(part.size()) + " cells, has none");
  }
}

}  // namespace

std::unique_ptr<TissueModel> makeHoneycomb(const ModelDescription& description) {
  const OrganDescription& organ = description.organs.front();
  const mesh::TetMesh mesh = organ.tetrahedra();
  const fem::Composition composition = organ.composition(mesh);
  refuse(organ, composition);
  if (description.settings.touching.self) {
    throw std::invalid_argument("contact.self: cells of model honeycomb do not touch each other");
  }
  HoneycombParts parts = partsOf(mesh, composition, organ.honeycomb.cell_size);
  parts.free = freeInOrgan(organ, parts.lattice.corners);
  parts.X_WO = organ.X_WO;
  requireHeld(parts.lattice, heldSides(parts.lattice, parts.free));
  if (description.warnings && description.settings.needles) {
    description.warnings->push_back("organ " + organ.name +
                                    ": needles do not get into model honeycomb");
  }
  ModelSettings settings = description.settings;
  settings.contact.friction_with = organ.friction;
  return std::make_unique<HoneycombOrgan>(std::move(parts), organ.honeycomb, settings);
}

}  // namespace palpate::tissue

PALPATE_TISSUE_MODEL(honeycomb, palpate::tissue::makeHoneycomb)
