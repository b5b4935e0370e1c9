// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/model_list.h"

#include <stdexcept>

#include "fem/make_fem.h"
#include "palpate/base/error.h"
#include "tissue/model_library.h"

namespace palpate::tissue {
namespace {

struct Entry {
  const char* name;
  ModelMaker make;  // null: loaded from a library, model_library.h
  bool owns_all;    // one model for all its organs
};

// Every tissue model, the default first. To add one: docs/adding_a_model.md.
constexpr Entry kModels[] = {
    {"fem", makeFem, true},         {"mass_spring", nullptr, true},
    {"tensor_mass", nullptr, true}, {"cloth", nullptr, true},
    {"hybrid", nullptr, true},      {"sampled_elasticity", nullptr, false},
    {"honeycomb", nullptr, false},  {"bem", nullptr, false},
    {"enriched", nullptr, true},    {"neural", nullptr, false},
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
  const Entry& entry = find(name);
  return (entry.make ? entry.make : makerInLibrary(name))(description);
}

}  // namespace palpate::tissue
