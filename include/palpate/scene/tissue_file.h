// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/material/solid.h"
#include "palpate/scene/body_config.h"

namespace palpate::scene {

/// Where numbers of a tissue come from.
struct TissueSource {
  std::string values;    ///< Which keys: "c10, c01".
  std::string cite;      ///< Author, year, where.
  std::string measured;  ///< What was measured, how, of which species.
  std::string read;      ///< first_hand | secondary | not_read
  std::string note;      ///< How the numbers were converted or chosen; may be empty.
};

/// What nobody measured.
struct TissueChoice {
  std::string values;  ///< Which keys.
  std::string why;
};

/// A tissue of the library: a material with where its numbers come from.
struct TissueFile {
  std::string file;  ///< Where it was read.
  std::string description;
  MaterialConfig material;  ///< Never by `file`.
  std::vector<TissueSource> sources;
  std::vector<TissueChoice> choices;
};

/// How the writer of a tissue file knows a source.
std::vector<std::string> sourceReadingNames();

/// @throws InputError with all problems of the file, among them constants, a density or a
/// relaxation that no source or choice accounts for.
TissueFile readTissueFile(const std::string& file);

/// A material whose constants are known, and where these stand.
struct WrittenMaterial {
  MaterialConfig config;  ///< Never by `file`.
  std::string file, key;
};

/// The constants of a material: its own, or those of its tissue file. `file` and `key` as for
/// makeSolid(), which throws the same.
WrittenMaterial writtenOut(const MaterialConfig& material, const std::string& file,
                           const std::string& key);

/// What a material is: written out, or as its tissue file says. `file` is the scene or case, whose
/// folder paths start from, and `key` the material in it.
/// @throws InputError in the name of `file` for a path that leads nowhere, or of the tissue file.
material::Solid makeSolid(const MaterialConfig& material, const std::string& file,
                          const std::string& key);

/// docs/tissues.md, from the tissue files of a folder.
/// @throws InputError as readTissueFile(), or if there is no such folder.
std::string tissuesMarkdown(const std::string& folder);

}  // namespace palpate::scene
