// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <sstream>

#include "palpate/base/error.h"
#include "palpate/base/number.h"
#include "palpate/material/material.h"
#include "palpate/scene/tissue_file.h"

namespace palpate::scene {
namespace {

std::vector<std::filesystem::path> tissueFiles(const std::string& folder) {
  if (!std::filesystem::is_directory(folder)) {
    throw InputError(folder, "", "", "there is no such folder");
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Three digits with a suitable unit: "2 kPa".
std::string pressureText(double pascal) {
  const bool mega = pascal >= 1.0e6, kilo = pascal >= 1.0e3;
  std::ostringstream text;
  text << std::setprecision(3)
       << pascal / (mega   ? 1.0e6
                    : kilo ? 1.0e3
                           : 1.0)
       << (mega   ? " MPa"
           : kilo ? " kPa"
                  : " Pa");
  return text.str();
}

std::string relaxationText(const std::vector<material::PronyTerm>& prony) {
  std::string text;
  for (const material::PronyTerm& term : prony) {
    text +=
        (text.empty() ? "" : ", ") + formatNumber(term.g) + " in " + formatNumber(term.tau) + " s";
  }
  return text.empty() ? "-" : text;
}

std::string sourcesText(const TissueFile& tissue) {
  std::string text;
  for (const TissueSource& s : tissue.sources) {
    text += "- " + s.values + ": " + s.cite + " (" + s.read + "). " + s.measured +
            (s.note.empty() ? "" : " " + s.note) + "\n";
  }
  for (const TissueChoice& c : tissue.choices)
    text += "- " + c.values + ": chosen. " + c.why + "\n";
  return text;
}

}  // namespace

std::string tissuesMarkdown(const std::string& folder) {
  std::string table, sections;
  for (const std::filesystem::path& path : tissueFiles(folder)) {
    const std::string name = path.stem().string();
    const TissueFile tissue = readTissueFile(path.string());
    const material::Solid solid = makeSolid(tissue.material, path.string(), "");
    const material::Moduli moduli = material::moduli(solid.law);
    table += "| [" + name + "](#" + name + ") | `" + tissue.material.law + "` | " +
             pressureText(moduli.mu) + " | " + pressureText(moduli.kappa) + " | " +
             formatNumber(solid.density) + " | " + relaxationText(solid.prony) + " | " +
             (material::needsFibres(solid.law) ? "yes" : "-") + " |\n";
    sections += "\n## " + name + "\n\n" + tissue.description + "\n\n" + sourcesText(tissue);
  }
  return "# Tissues\n\n"
         "The materials in `config/materials`, for `material: {file: ...}` in scenes and cases.\n"
         "This page is generated from them:\n\n"
         "    palpate docs tissues > docs/tissues.md\n\n"
         "The moduli are those of small strains under a sudden load; of laws with fibres, those "
         "of\n"
         "the matrix between them. Where a part relaxes, `0.55 in 1.1 s` say, the shear modulus\n"
         "falls by that part with that time constant, so 0.45 of it is left after long; the bulk\n"
         "modulus does not relax. Where none does, no numbers for the times of a hand were found.\n"
         "`first_hand` means read in the source itself, `secondary` in a text that cites it, and\n"
         "`not_read` from memory: check it before anything rests on it. No source measures the\n"
         "bulk modulus or Poisson's ratio of these tissues; all are choices.\n\n"
         "| tissue | law | shear modulus | bulk modulus | density [kg/m^3] | relaxing part | needs "
         "fibres |\n|---|---|---|---|---|---|---|\n" +
         table + sections;
}

}  // namespace palpate::scene
