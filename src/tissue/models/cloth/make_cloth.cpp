// SPDX-License-Identifier: GPL-3.0-or-later
#include "make_cloth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/contact/layer_contact.h"
#include "palpate/springs/network_statics.h"
#include "rolled_shape.h"
#include "sheet_elasticity.h"
#include "sheet_network.h"
#include "tissue/groups/make_organs.h"
#include "tissue/model_library.h"
#include "tissue/models/springs/spring_steps.h"
#include "tissue/organ/fem_organ.h"

namespace palpate::tissue {
namespace {

// Of the largest force of a spring at rest, when the free sheet is in balance.
constexpr double kBalance = 1e-10;
// Layers are pressed to the least gap by hundreds of times what bends the sheet to a roll.
constexpr double kLayerPressure = 10.0;

void refuse(const OrganDescription& organ, const fem::Composition& composition,
            const Surroundings& surroundings) {
  if (organ.adapt.on()) {
    throw std::invalid_argument("adapt: the mesh of model cloth stays; leave adapt out");
  }
  if (!composition.frames.empty()) {
    throw std::invalid_argument(
        "model cloth is the same in all directions; choose a law without fibres");
  }
  for (const material::Solid& solid : composition.solids) {
    if (!solid.prony.empty()) {
      throw std::invalid_argument("model cloth has no viscous memory; leave viscoelastic out");
    }
  }
  if (!surroundings.springs.empty() || !surroundings.pressures.empty()) {
    throw std::invalid_argument("model cloth is held by `kind: glue` alone, and not pressed");
  }
  if (organ.cloth.rolled && !surroundings.carried.empty()) {
    throw std::invalid_argument(
        "cloth.rolled: supports of a rolled sheet do not move; leave "
        "motion out");
  }
}

// Supports must bear forces in the plane, which are large against those of bending.
double slenderness(const Points& X, double thickness) {
  return thickness / (X.rowwise().maxCoeff() - X.rowwise().minCoeff()).norm();
}

// What a sheet resists is to be bent across its size: as soft as that is the solid by which forces
// are judged to be small.
fem::Composition asSoftAsBending(const material::Solid& solid, const Points& X, double thickness) {
  const material::Moduli m = material::moduli(solid.law);
  const double part = std::pow(slenderness(X, thickness), 2);
  const double E = 9.0 * m.kappa * m.mu / (3.0 * m.kappa + m.mu);
  const double nu = (3.0 * m.kappa - 2.0 * m.mu) / (6.0 * m.kappa + 2.0 * m.mu);
  return fem::Composition::uniform(
      material::makeMaterial("neo_hookean",
                             {{"young_modulus", {part * E}}, {"poisson_ratio", {nu}}}),
      solid.density);
}

double meanLength(const springs::SpringNetwork& network) {
  double sum = 0.0;
  int count = 0;
  for (const springs::Spring& s : network.springs) {
    if (s.kind != springs::SpringKind::kStructural) continue;
    sum += s.length;
    ++count;
  }
  return sum / std::max(count, 1);
}

// Preload draws free edges in a little.
Points balanced(const springs::SpringNetwork& network, const fem::FreeMask& free) {
  double largest = 0.0;
  for (const springs::Spring& s : network.springs) largest = std::max(largest, std::abs(s.preload));
  Points x = network.points;
  if (largest == 0.0) return x;
  springs::NetworkLoads loads = springs::noLoads(network);
  loads.free = free;
  const springs::NetworkStaticsReport report =
      springs::solveNetwork(network, loads, {kBalance * largest}, &x);
  if (report.status == solver::SolveStatus::kConverged) return x;
  throw std::runtime_error("the sheet does not come to rest under its preload: " +
                           std::string(solver::toString(report.status)));
}

std::shared_ptr<contact::LayerContact> layersOf(const OrganDescription& organ,
                                                const material::Solid& solid,
                                                const SheetNetwork& sheet) {
  const RolledSettings& rolled = *organ.cloth.rolled;
  const material::Moduli m = material::moduli(solid.law);
  const double E = 9.0 * m.kappa * m.mu / (3.0 * m.kappa + m.mu), h = organ.cloth.thickness;
  const Points& X = sheet.network.points;
  const double length = X.row(1).maxCoeff() - X.row(1).minCoeff();
  const double radius = rolled.radius * spiralLeft(rolled, length);  // of the innermost layer
  const double pressure = kLayerPressure * E * h * h * h / (12.0 * radius * radius * radius);
  return std::make_shared<contact::LayerContact>(
      X, sheet.triangles, sheet.network.masses / (solid.density * h),
      contact::LayerSettings{rolled.gap_least, rolled.gap_most, pressure});
}

std::function<std::unique_ptr<StepMethod>(FemBody*)> methodOf(
    const OrganDescription& organ, const std::shared_ptr<SheetElasticity>& elasticity,
    double layers_square) {
  if (organ.springs.scheme == SpringSettings().scheme) return {};
  SpringStepSettings settings{&springIntegrator(organ.springs.scheme), organ.springs.step,
                              organ.springs.region, layers_square};
  if (settings.radius == 0.0) settings.radius = std::numeric_limits<double>::infinity();
  return [elasticity, settings](FemBody* body) {
    return std::make_unique<SpringSteps>(body, &elasticity->forces(), settings);
  };
}

// The others know nothing of layers, whose stiffness would bound their step, or has to be known
// before they begin.
void checkMethodOfRoll(const OrganDescription& organ, const std::string& method) {
  if (organ.springs.scheme != SpringSettings().scheme) return;
  const std::vector<std::string> known = {"implicit_pcg", "implicit_direct", "implicit_async",
                                          "lbfgs"};
  if (std::count(known.begin(), known.end(), method) > 0) return;
  throw std::invalid_argument("cloth.rolled: method " + method +
                              " knows no layers; choose one of " + joinNames(known));
}

std::unique_ptr<OrganBodies> makeSheet(const OrganDescription& organ,
                                       const ModelDescription& description) {
  const fem::Composition composition = organ.composition({});
  const material::Solid& solid = composition.solids.front();
  OwnParts own{"cloth by " + organ.springs.scheme, nullptr, {}, {}};
  SheetNetwork sheet = sheetNetwork(organ, solid, &own.notes);
  springs::SpringNetwork& network = sheet.network;
  mesh::TetMesh mesh;
  mesh.points = network.points;
  const Surroundings surroundings = organ.surroundings(mesh);
  refuse(organ, composition, surroundings);

  double layers_square = 0.0;
  Points start;
  if (organ.cloth.rolled) {
    checkMethodOfRoll(organ, description.settings.method);
    start =
        organ.X_WO *
        rolledUp(network.points, meanLength(network), *organ.cloth.rolled).colwise().homogeneous();
    const auto layers = layersOf(organ, solid, sheet);
    layers_square = layers->largestSquare(network.masses);
    own.load = layers;
  }
  network.points = (organ.X_WO * network.points.colwise().homogeneous()).eval();
  mesh.points = network.points;
  if (organ.cloth.rolled) {
    own.start = start;
  } else if (description.settings.gravity.isZero()) {
    own.start = balanced(network, surroundings.free);
  }
  const auto elasticity =
      std::make_shared<SheetElasticity>(network, sheet.triangles, organ.cloth.thickness);
  own.elasticity = elasticity;
  own.surface = sheet.triangles;
  own.method = methodOf(organ, elasticity, layers_square);
  FemSettings settings = settingsOf(organ, description);
  settings.element = own.name;
  settings.thickness = organ.cloth.thickness;
  settings.tolerance *= slenderness(mesh.points, organ.cloth.thickness);
  return makeFemOrgan(mesh, asSoftAsBending(solid, mesh.points, organ.cloth.thickness),
                      surroundings, settings, description.pool, own);
}

}  // namespace

std::unique_ptr<TissueModel> makeCloth(const ModelDescription& description) {
  ModelDescription alone = description;
  alone.settings.touching.organs = false;
  return makeOrgans(alone, [&](const OrganDescription& organ) { return makeSheet(organ, alone); });
}

}  // namespace palpate::tissue

PALPATE_TISSUE_MODEL(cloth, palpate::tissue::makeCloth)
