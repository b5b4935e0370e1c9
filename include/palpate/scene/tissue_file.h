// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/material/solid.h"
#include "palpate/scene/body_config.h"

namespace palpate::scene {

/// Source of values of a tissue.
struct TissueSource {
  std::string values;    ///< Keys with this source: "c10, c01".
  std::string cite;      ///< Author, year, page or table.
  std::string measured;  ///< Measured quantity, method, species.
  std::string read;      ///< first_hand | secondary | not_read
  std::string note;      ///< Conversion or choice of the values; may be empty.
};

/// Assumed values without a measurement.
struct TissueChoice {
  std::string values;  ///< Keys with this assumption.
  std::string why;
};

/// A tissue of the library: a material with the sources of its values.
struct TissueFile {
  std::string file;  ///< Path of the tissue file.
  std::string description;
  MaterialConfig material;  ///< Without `file`.
  std::vector<TissueSource> sources;
  std::vector<TissueChoice> choices;
};

/// Allowed values of TissueSource::read.
std::vector<std::string> sourceReadingNames();

/// @throws InputError with all problems of the file, also constants, density or relaxation without
/// source or choice.
TissueFile readTissueFile(const std::string& file);

/// A material with constants, and the position of these in a file.
struct WrittenMaterial {
  MaterialConfig config;  ///< Without `file`.
  std::string file, key;
};

/// The constants of a material, its own or those of its tissue file. `file`, `key` and exceptions
/// as for makeSolid().
WrittenMaterial writtenOut(const MaterialConfig& material, const std::string& file,
                           const std::string& key);

/// Solid of a material, by its own constants or its tissue file. `file`: the scene or case, whose
/// folder relative paths start from; `key`: the material in it.
/// @throws InputError with the name of `file` for a wrong path, or of the tissue file.
material::Solid makeSolid(const MaterialConfig& material, const std::string& file,
                          const std::string& key);

/// Text of docs/tissues.md, from the tissue files of a folder.
/// @throws InputError as readTissueFile(), or for a missing folder.
std::string tissuesMarkdown(const std::string& folder);

}  // namespace palpate::scene
