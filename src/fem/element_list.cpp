// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdexcept>

#include "palpate/base/error.h"
#include "palpate/fem/elasticity.h"
#include "solid_elasticity.h"

namespace palpate::fem {
namespace {

// Bulk modulus that linear tetrahedra keep when pressures are averaged, in units of mu. Without it,
// volumes alternate between neighbours at no cost. A fixed part of kappa would lock again near
// incompressibility.
constexpr double kElementModulus = 0.5;

constexpr VolumeTreatment kByElement{};
constexpr VolumeTreatment kAveraged{kElementModulus, NodalPressure::Kind::kAveraged};
constexpr VolumeTreatment kStabilised{0.0, NodalPressure::Kind::kStabilised};

template <int N>
std::unique_ptr<Elasticity> make(const TetMesh& mesh, const Composition& composition,
                                 ThreadPool* pool, const VolumeTreatment& treatment) {
  return std::make_unique<SolidElasticity<N>>(mesh, composition, pool, treatment);
}

// All elements. To add one, write its header and source and list it here.
struct Entry {
  const char* name;
  decltype(&make<4>) make;
  VolumeTreatment treatment;
  bool quadratic;
};
constexpr Entry kElements[] = {
    {"anp", make<4>, kAveraged, false},    {"tet4", make<4>, kByElement, false},
    {"tet10", make<10>, kByElement, true}, {"tet10p", make<10>, kAveraged, true},
    {"p1p1", make<4>, kStabilised, false},
};

void refuseFibresWithoutFrames(const Composition& composition) {
  for (const material::Solid& solid : composition.solids) {
    if (!composition.frames.empty() || !material::needsFibres(solid.law)) continue;
    throw std::invalid_argument("law " + material::lawName(solid.law) +
                                " has fibres and needs their directions");
  }
}

const Entry& find(const std::string& element) {
  for (const Entry& entry : kElements) {
    if (element == entry.name) return entry;
  }
  throw std::invalid_argument("element = " + element + ": must be one of " +
                              joinNames(elementNames()));
}

}  // namespace

std::vector<std::string> elementNames() {
  std::vector<std::string> names;
  for (const Entry& entry : kElements) names.emplace_back(entry.name);
  return names;
}

bool isQuadratic(const std::string& element) { return find(element).quadratic; }

TetMesh meshFor(const std::string& element, const TetMesh& mesh) {
  return isQuadratic(element) && !mesh.quadratic() ? mesh::toQuadratic(mesh) : mesh;
}

std::unique_ptr<Elasticity> makeElasticity(const std::string& element, const TetMesh& mesh,
                                           const Composition& composition, ThreadPool* pool) {
  const Entry& entry = find(element);
  refuseFibresWithoutFrames(composition);
  return entry.make(mesh, composition, pool, entry.treatment);
}

}  // namespace palpate::fem
