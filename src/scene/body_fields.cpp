// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/scene/body_fields.h"

#include <stdexcept>

#include "palpate/material/material.h"
#include "palpate/scene/scene_fields.h"

namespace palpate::scene {
namespace {

// Requirement of a law on its constants, as a sentence.
std::string needsOf(const std::string& law) {
  try {
    material::makeMaterial(law, {});
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "needs none";
}

std::vector<keys::Kind> laws() {
  std::vector<keys::Kind> all;
  for (const std::string& law : material::materialNames()) {
    all.push_back({law, material::constantNames(law), needsOf(law)});
  }
  return all;
}

// Reports the problems of a law's constants, each at the constant if it is known.
void checkConstants(keys::FieldVisitor& v, const MaterialConfig& material) {
  try {
    material::makeMaterial(material.law, material.constants);
  } catch (const material::ConstantError& e) {
    const bool blames = material.constants.count(e.name) > 0;
    v.rule(false, blames ? e.name : "", blames ? e.allowed : e.what());
  } catch (const std::invalid_argument& e) {
    v.rule(false, "", e.what());
  }
}

// Problem of the Prony series as a whole, or "". Terms out of range are reported at their keys,
// other problems of the law at its constants.
std::string pronyProblem(const MaterialConfig& material) {
  try {
    material::checkProny(material::makeMaterial(material.law, material.constants),
                         material.viscoelastic);
  } catch (const material::PronyError& error) {
    return error.term ? "" : error.what();
  } catch (const std::invalid_argument&) {
  }
  return "";
}

bool parallel(const Vec3& a, const Vec3& b) {
  return a.cross(b).norm() <= 1.0e-6 * a.norm() * b.norm();
}

}  // namespace

void describeLaw(keys::FieldVisitor& v, MaterialConfig& material) {
  v.choice({"law", "", "Elastic law."}, material.law, material::materialNames());
  v.number({"density", "kg/m^3", "Mass per volume at rest."}, material.density,
           keys::Range::above(0.0, 1.0e5));
  v.list({"viscoelastic", "",
          "Prony series; the law's constants are those of a sudden load, and 1 - sum of g of the "
          "distortional stress is left after long."},
         material.viscoelastic, 0);
  static const std::vector<keys::Kind> kLaws = laws();
  const bool known = !material::constantNames(material.law).empty();
  if (v.numbersOfKind("law", kLaws, material.law, material.constants) && known) {
    checkConstants(v, material);
  }
  v.rule(true, "viscoelastic", "the sum of g must be < 1, and the law one for large rotations");
  const std::string problem = pronyProblem(material);
  if (!problem.empty()) v.rule(false, "viscoelastic", problem);
}

void describe(keys::FieldVisitor& v, MaterialConfig& material) {
  const bool file =
      v.text({"file", "",
              "A tissue of the library (`config/materials`) in the place of all other keys; a path "
              "from this file's folder, absolute, `file://` or `package://`."},
             material.file);
  v.onlyIf(!file, "no file", [&] { describeLaw(v, material); });
}

void describe(keys::FieldVisitor& v, FibreConfig& fibres) {
  const bool direction = v.vector3({"direction", "", "Of the fibres, of any length but zero."},
                                   fibres.direction, keys::Range::closed(-1.0e6, 1.0e6));
  const bool field = v.text(
      {"field", "", "Their directions: cell data of three components of a .vtk or .vtu mesh."},
      fibres.field);
  v.rule(direction != field, "", "needs exactly one of direction, field");
  const bool sheet = v.vector3({"sheet", "",
                                "Direction of the sheets in which the fibres lie; its part along "
                                "the fibre is left out. By default any across the fibre."},
                               fibres.sheet, keys::Range::closed(-1.0e6, 1.0e6));
  const bool sheet_field =
      v.text({"sheet_field", "", "The same, as cell data."}, fibres.sheet_field);
  v.rule(!(sheet && sheet_field), "", "needs at most one of sheet, sheet_field");
  const bool zero = fibres.direction && !(fibres.direction->norm() > 1.0e-9);
  v.rule(!zero, "direction", "the direction must not be zero");
  const bool along =
      fibres.direction && fibres.sheet && !zero && parallel(*fibres.direction, *fibres.sheet);
  v.rule(!along, "sheet", "the sheet must not be zero or parallel to the direction");
}

void describe(keys::FieldVisitor& v, RegionConfig& region) {
  v.name({"name", "", "Names the region in messages.", keys::Need::kRequired}, region.name);
  v.section({"select", "",
             "Tetrahedra, by their centroid unless it says otherwise; coordinates in the body's "
             "own frame, after scaling.",
             keys::Need::kRequired},
            region.select);
  const bool material =
      v.section({"material", "", "What it is made of, if not as the body."}, region.material);
  const bool fibres =
      v.section({"fibres", "", "Its directions, if not the body's."}, region.fibres);
  v.rule(material || fibres, "", "needs at least one of material, fibres");
}

void describe(keys::FieldVisitor& v, BodyConfig& body) {
  v.section({"material", "", "What the body is made of.", keys::Need::kRequired}, body.material);
  v.section({"fibres", "",
             "Directions in the body's own frame, which turn with its pose; needed by laws with "
             "fibres."},
            body.fibres);
  v.list({"regions", "", "Parts that differ; where they overlap, the later one holds."},
         body.regions, 0);
  v.uniqueNames("regions", body.regions);
}

}  // namespace palpate::scene
