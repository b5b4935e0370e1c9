// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "palpate/tissue/model_description.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

using ModelMaker = std::unique_ptr<TissueModel> (*)(const ModelDescription&);

/// Loads libpalpate_model_<name>.so from this library's folder or the system's search path, and
/// returns the maker of model `name`. Libraries stay loaded.
/// @throws std::invalid_argument that names the library where it is missing or has no such model.
ModelMaker makerInLibrary(const std::string& name);

}  // namespace palpate::tissue

/// Defines the export of a model's library for makerInLibrary(), once in a source, outside of
/// namespaces.
#define PALPATE_TISSUE_MODEL(name, make)                         \
  extern "C" {                                                   \
  extern const palpate::tissue::ModelMaker palpate_model_##name; \
  const palpate::tissue::ModelMaker palpate_model_##name = make; \
  }
