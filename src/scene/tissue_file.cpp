// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/scene/tissue_file.h"

#include <filesystem>
#include <set>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "palpate/base/error.h"
#include "palpate/base/resource.h"
#include "palpate/keys/yaml_reader.h"
#include "palpate/scene/body_fields.h"

namespace palpate::scene {
namespace {

// Adds the words of a list "a, b".
void addWords(const std::string& list, std::set<std::string>* words) {
  std::istringstream stream(list);
  for (std::string word; std::getline(stream, word, ',');) {
    const std::size_t begin = word.find_first_not_of(' ');
    if (begin == std::string::npos) continue;
    words->insert(word.substr(begin, word.find_last_not_of(' ') + 1 - begin));
  }
}

// Keys without source or choice.
std::vector<std::string> unaccounted(const TissueFile& tissue) {
  std::set<std::string> accounted;
  for (const TissueSource& source : tissue.sources) addWords(source.values, &accounted);
  for (const TissueChoice& choice : tissue.choices) addWords(choice.values, &accounted);
  std::vector<std::string> keys = {"density"};
  if (!tissue.material.viscoelastic.empty()) keys.emplace_back("viscoelastic");
  for (const auto& [name, values] : tissue.material.constants) keys.push_back(name);
  std::vector<std::string> missing;
  for (const std::string& key : keys) {
    if (!accounted.count(key)) missing.push_back(key);
  }
  return missing;
}

}  // namespace

void describe(keys::FieldVisitor& v, TissueSource& source) {
  v.text({"values", "", "Keys of the file whose numbers it gives, with commas.",
          keys::Need::kRequired},
         source.values);
  v.text({"cite", "", "Author, year, where published.", keys::Need::kRequired}, source.cite);
  v.text({"measured", "", "What was measured, how, of which species.", keys::Need::kRequired},
         source.measured);
  v.choice({"read", "",
            "`first_hand`: read in the source itself; `secondary`: read in a text that cites it; "
            "`not_read`: from memory, to be checked before anything rests on it.",
            keys::Need::kRequired},
           source.read, sourceReadingNames());
  v.text({"note", "", "How the numbers were converted or chosen."}, source.note);
}

void describe(keys::FieldVisitor& v, TissueChoice& choice) {
  v.text(
      {"values", "", "Keys of the file that nobody measured, with commas.", keys::Need::kRequired},
      choice.values);
  v.text({"why", "", "Why they are so.", keys::Need::kRequired}, choice.why);
}

void describe(keys::FieldVisitor& v, TissueFile& tissue) {
  v.text({"description", "", "What it is.", keys::Need::kRequired}, tissue.description);
  describeLaw(v, tissue.material);
  v.list({"sources", "", "Where the numbers come from.", keys::Need::kRequired}, tissue.sources, 1);
  v.list({"choices", "", "What is not measured but chosen."}, tissue.choices, 0);
  v.rule(true, "", "density, every constant and viscoelastic need a source or a choice");
  const std::vector<std::string> missing = unaccounted(tissue);
  if (!missing.empty()) v.rule(false, "", "needs a source or a choice for " + joinNames(missing));
}

std::vector<std::string> sourceReadingNames() { return {"first_hand", "secondary", "not_read"}; }

TissueFile readTissueFile(const std::string& file) {
  TissueFile tissue;
  tissue.file = file;
  keys::readYaml(file, [&](keys::FieldVisitor& v) { describe(v, tissue); });
  return tissue;
}

WrittenMaterial writtenOut(const MaterialConfig& material, const std::string& file,
                           const std::string& key) {
  if (material.file.empty()) return {material, file, key};
  const std::string place = key + ".file";
  std::string path;
  try {
    path = resolveResource(material.file, std::filesystem::path(file).parent_path().string());
  } catch (const std::invalid_argument& error) {
    throw InputError(file, place, material.file, error.what());
  }
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    throw InputError(file, place, material.file, "there is no file " + path);
  }
  return {readTissueFile(path).material, path, ""};
}

material::Solid makeSolid(const MaterialConfig& material, const std::string& file,
                          const std::string& key) {
  const WrittenMaterial written = writtenOut(material, file, key);
  const MaterialConfig& config = written.config;
  try {
    material::Solid solid{material::makeMaterial(config.law, config.constants), config.density,
                          config.viscoelastic};
    material::checkProny(solid.law, solid.prony);
    return solid;
  } catch (const std::invalid_argument& error) {
    throw InputError(written.file, written.key, "", error.what());
  }
}

}  // namespace palpate::scene
