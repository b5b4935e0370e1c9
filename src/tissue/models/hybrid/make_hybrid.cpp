// SPDX-License-Identifier: GPL-3.0-or-later
#include "make_hybrid.h"

#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "hybrid_elasticity.h"
#include "hybrid_steps.h"
#include "tissue/groups/make_organs.h"
#include "tissue/model_library.h"
#include "tissue/models/cells/make_cells.h"

namespace palpate::tissue {
namespace {

void refuse(const OrganDescription& organ, const FemSettings& settings) {
  if (!organ.hybrid.region) {
    throw std::invalid_argument(
        "hybrid.region: model hybrid needs to know which tetrahedra are of tensors");
  }
  if (settings.needles) {
    throw std::invalid_argument(
        "model hybrid knows no needle that goes in; leave the instruments' needle out");
  }
}

// Points that are eliminated look held to the body's own check.
void checkHeld(const mesh::TetMesh& mesh, const Surroundings& surroundings,
               const FemSettings& settings, bool all_linear) {
  const BodySurroundings around(surroundings, mesh);
  const bool loaded = !settings.gravity.isZero() || around.actsAtRest();
  if (!loaded && !all_linear) return;
  const std::string motions =
      fem::freeRigidMotions(mesh.points, surroundings.free, around.heldDirections());
  if (motions.empty()) return;
  throw std::invalid_argument(
      (loaded ? std::string("gravity or pressure would move the body")
              : std::string("hybrid.region has no tetrahedron, so nothing has inertia")) +
      ", and its supports leave " + motions + "; hold more of it");
}

// Of each point whether its surroundings do more to it than hold it.
std::vector<char> actedOn(const Surroundings& surroundings, Eigen::Index num_points) {
  std::vector<char> acted(static_cast<std::size_t>(num_points), 0);
  const auto mark = [&](const auto& items) {
    for (const auto& item : items) {
      for (const int i : item.nodes) acted[static_cast<std::size_t>(i)] = 1;
    }
  };
  mark(surroundings.carried);
  mark(surroundings.springs);
  mark(surroundings.pressures);
  return acted;
}

void checkLoop(const HybridElasticity& elasticity, const fem::FreeMask& free,
               const FemSettings& settings) {
  const LinearPart* rest = elasticity.rest();
  if (!rest) return;
  const std::string key = "hybrid.exchange = loop: ";
  if (elasticity.numBorder() != static_cast<int>(rest->kept().size())) {
    throw std::invalid_argument(
        key + "what acts on the linear part beside tools, weight and supports that hold all of a " +
        "point it does not know; choose monolithic or enlarge hybrid.region");
  }
  if (settings.integrator != "backward_euler") {
    throw std::invalid_argument(key +
                                "goes with integrator backward_euler; choose it or monolithic");
  }
  const double longest = elasticity.longestStepOfLoop(free, settings.mass_damping);
  if (settings.step <= longest) return;
  std::ostringstream text;
  text.precision(2);
  text << key << "is stable in steps up to " << longest << " s, and solver.step is "
       << settings.step
       << "; shorten it, choose monolithic, or a region that is stiffer or heavier";
  throw std::invalid_argument(text.str());
}

std::string note(const mesh::TetMesh& mesh, const HybridElasticity& elasticity) {
  std::ostringstream text;
  text.precision(2);
  text << "model hybrid: " << elasticity.region().size() << " of " << mesh.numTets()
       << " tetrahedra are of tensors";
  if (const LinearPart* rest = elasticity.rest()) {
    text << ", the others share " << elasticity.numBorder() << " points with them and have "
         << rest->surface().size() << " on the surface ("
         << 1e-6 * static_cast<double>(rest->memory()) << " MB)";
  }
  return text.str();
}

std::unique_ptr<OrganBodies> makeOne(const OrganDescription& organ,
                                     const ModelDescription& description) {
  FemSettings settings = settingsOf(organ, description);
  refuse(organ, settings);
  mesh::TetMesh mesh = organ.tetrahedra();
  Surroundings surroundings = organ.surroundings(mesh);
  const fem::Composition composition = organ.composition(mesh);
  refuseForCells("hybrid", organ, composition);
  const std::vector<int> region = mesh::selectTets(mesh, *organ.hybrid.region);
  mesh.points = (organ.X_WO * mesh.points.colwise().homogeneous()).eval();
  checkHeld(mesh, surroundings, settings, region.empty());
  const bool loop = organ.hybrid.exchange == "loop";
  const auto elasticity =
      std::make_shared<HybridElasticity>(mesh, composition, region, surroundings.free,
                                         settings.gravity, actedOn(surroundings, mesh.numPoints()));
  if (loop) checkLoop(*elasticity, surroundings.free, settings);
  if (const LinearPart* rest = elasticity->rest()) {
    for (const int i : rest->inner()) surroundings.free.col(i).setZero();
  }
  OwnParts own{"hybrid by " + organ.hybrid.exchange, elasticity, {}, {note(mesh, *elasticity)}};
  own.method = [elasticity, loop](FemBody* body) {
    return std::make_unique<HybridSteps>(body, elasticity.get(), loop);
  };
  settings.element = own.name;
  return makeFemOrgan(mesh, composition, surroundings, settings, description.pool, own);
}

}  // namespace

std::unique_ptr<TissueModel> makeHybrid(const ModelDescription& description) {
  return makeOrgans(description,
                    [&](const OrganDescription& organ) { return makeOne(organ, description); });
}

}  // namespace palpate::tissue

PALPATE_TISSUE_MODEL(hybrid, palpate::tissue::makeHybrid)
