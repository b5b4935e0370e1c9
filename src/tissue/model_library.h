// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "palpate/tissue/model_description.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

using ModelMaker = std::unique_ptr<TissueModel> (*)(const ModelDescription&);

/// The maker of model `name` in libpalpate_model_<name>.so, which is loaded from the folder of this
/// library, or from where the system looks for libraries. A loaded library stays until the program
/// ends.
/// @throws std::invalid_argument that names the library if it is not there or has no such model.
ModelMaker makerInLibrary(const std::string& name);

}  // namespace palpate::tissue

/// What a library of model `name` exports for makerInLibrary(): once in a source, outside of
/// namespaces.
#define PALPATE_TISSUE_MODEL(name, make)                         \
  extern "C" {                                                   \
  extern const palpate::tissue::ModelMaker palpate_model_##name; \
  const palpate::tissue::ModelMaker palpate_model_##name = make; \
  }
