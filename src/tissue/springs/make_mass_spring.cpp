// SPDX-License-Identifier: GPL-3.0-or-later
#include "make_mass_spring.h"

#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "spring_elasticity.h"
#include "spring_steps.h"
#include "tissue/cells/make_cells.h"

namespace palpate::tissue {
namespace {

constexpr int kEdges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

double youngModulus(const material::Solid& solid) {
  const material::Moduli m = material::moduli(solid.law);
  return 9.0 * m.kappa * m.mu / (3.0 * m.kappa + m.mu);
}

springs::SpringNetwork networkOf(const mesh::TetMesh& mesh, const fem::Composition& composition) {
  std::map<std::pair<int, int>, double> works;  // E V of the tetrahedra around each edge
  springs::SpringNetwork network{mesh.points, {}, Eigen::VectorXd::Zero(mesh.numPoints())};
  for (int t = 0; t < static_cast<int>(mesh.numTets()); ++t) {
    const material::Solid& solid = composition.solid(t);
    const double volume = mesh::signedVolume(mesh.points, mesh.tets.col(t));
    for (const auto& e : kEdges) {
      works[std::minmax(mesh.tets(e[0], t), mesh.tets(e[1], t))] += youngModulus(solid) * volume;
    }
    for (int a = 0; a < 4; ++a) {
      network.masses[mesh.tets(a, t)] += 0.25 * solid.density * volume;
    }
  }
  for (const auto& [ends, work] : works) {
    const double length = (mesh.points.col(ends.first) - mesh.points.col(ends.second)).norm();
    network.springs.push_back({ends.first, ends.second, work / (length * length), 0.0, 0.0, length,
                               springs::SpringKind::kEdge});
  }
  return network;
}

OwnParts partsOf(const mesh::TetMesh& mesh, const fem::Composition& composition,
                 const OrganDescription& organ) {
  const auto elasticity =
      std::make_shared<SpringElasticity>(mesh, composition, networkOf(mesh, composition));
  OwnParts parts{"mass_spring by " + organ.springs.integrator, elasticity, {}};
  if (organ.springs.integrator == SpringSettings().integrator) return parts;
  SpringStepSettings settings{&springIntegrator(organ.springs.integrator), organ.springs.step,
                              organ.springs.region};
  if (settings.radius == 0.0) settings.radius = std::numeric_limits<double>::infinity();
  parts.method = [elasticity, settings](FemBody* body) {
    return std::make_unique<SpringSteps>(body, elasticity.get(), settings);
  };
  return parts;
}

}  // namespace

std::unique_ptr<TissueModel> makeMassSpring(const ModelDescription& description) {
  return makeCells("mass_spring", description, partsOf);
}

}  // namespace palpate::tissue
