// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdexcept>

#include "palpate/base/error.h"
#include "palpate/fem/elasticity.h"
#include "tet4.h"

namespace palpate::fem {
namespace {

template <class Element>
std::unique_ptr<Elasticity> make(const TetMesh& mesh, const material::Material& material,
                                 ThreadPool* pool) {
  return std::make_unique<Element>(mesh, material, pool);
}

// Every element. To add one: write its header and source, add it here.
struct Entry {
  const char* name;
  decltype(&make<Tet4>) make;
};
constexpr Entry kElements[] = {
    {"tet4", make<Tet4>},
};

}  // namespace

std::vector<std::string> elementNames() {
  std::vector<std::string> names;
  for (const Entry& entry : kElements) names.emplace_back(entry.name);
  return names;
}

std::unique_ptr<Elasticity> makeElasticity(const std::string& element, const TetMesh& mesh,
                                           const material::Material& material, ThreadPool* pool) {
  for (const Entry& entry : kElements) {
    if (element == entry.name) return entry.make(mesh, material, pool);
  }
  throw std::invalid_argument("element = " + element + ": must be one of " +
                              joinNames(elementNames()));
}

}  // namespace palpate::fem
