// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/model_list.h"

#include <stdexcept>

#include "bem/make_bem.h"
#include "cloth/make_cloth.h"
#include "enriched/make_enriched.h"
#include "fem/make_fem.h"
#include "honeycomb/make_honeycomb.h"
#include "hybrid/make_hybrid.h"
#include "neural/make_neural.h"
#include "palpate/base/error.h"
#include "sampled/make_sampled.h"
#include "springs/make_mass_spring.h"
#include "tensor_mass/make_tensor_mass.h"

namespace palpate::tissue {
namespace {

struct Entry {
  const char* name;
  std::unique_ptr<TissueModel> (*make)(const ModelDescription&);
  bool owns_all;  // organs of that name, solved together
};

// Every tissue model, the default first. To add one: docs/adding_a_model.md.
constexpr Entry kModels[] = {
    {"fem", makeFem, true},
    {"mass_spring", makeMassSpring, true},
    {"tensor_mass", makeTensorMass, true},
    {"cloth", makeCloth, true},
    {"hybrid", makeHybrid, true},
    {"sampled_elasticity", makeSampledElasticity, false},
    {"honeycomb", makeHoneycomb, false},
    {"bem", makeBem, false},
    {"enriched", makeEnriched, true},
    {"neural", makeNeural, false},
};

const Entry& find(const std::string& name) {
  for (const Entry& entry : kModels) {
    if (name == entry.name) return entry;
  }
  throw std::invalid_argument("model = " + name + ": must be one of " + joinNames(modelNames()));
}

}  // namespace

std::vector<std::string> modelNames() {
  std::vector<std::string> names;
  for (const Entry& entry : kModels) names.emplace_back(entry.name);
  return names;
}

bool ownsAllOrgans(const std::string& name) { return find(name).owns_all; }

std::unique_ptr<TissueModel> makeModel(const std::string& name,
                                       const ModelDescription& description) {
  return find(name).make(description);
}

}  // namespace palpate::tissue
