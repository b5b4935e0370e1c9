// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_source.h"

#include <algorithm>

#include "options.h"
#include "organ_choice.h"
#include "palpate/base/error.h"
#include "palpate/base/number.h"
#include "palpate/formats/surface_io.h"
#include "palpate/mesh/size_check.h"
#include "palpate/mesh/surface_check.h"
#include "palpate/scene/organ_assembly.h"
#include "shipped.h"

namespace palpate::cli {
namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& value,
                         const std::string& reason) {
  throw InputError("command line", option, value, reason);
}

/// The point that "0.1,0,-0.2" says.
Vec3 pointOf(const std::string& text) {
  Vec3 point;
  std::size_t begin = 0;
  for (int i = 0; i < 3; ++i) {
    const std::size_t comma = text.find(',', begin);
    const bool last = comma == std::string::npos;
    const auto x = parseNumber(text.substr(begin, last ? comma : comma - begin));
    if (!x || last != (i == 2)) refuse("--near", text, "must be three numbers X,Y,Z [m]");
    point[i] = *x;
    begin = comma + 1;
  }
  return point;
}

mesh::SizeField fieldOf(const MeshChoice& choice) {
  mesh::SizeField field;
  field.coarsest = choice.edge_length;
  for (const std::string& text : choice.near) {
    mesh::RefinementZone place;
    place.finest = choice.finest.value_or(place.finest);
    place.radius = choice.radius.value_or(place.radius);
    place.growth = choice.growth.value_or(place.growth);
    place.where = mesh::Polyline{{pointOf(text)}};
    field.near.push_back(place);
  }
  return field;
}

void checkFile(const MeshChoice& choice) {
  if (!choice.organ.empty()) refuse("--organ", choice.organ, "needs --scene");
  requirePositive("--edge-length", choice.edge_length);
  if (choice.scale) requirePositive("--scale", *choice.scale);
  const bool graded = !choice.near.empty();
  if (graded && !choice.finest) refuse("--finest", "", "is missing: length of the edges near");
  if (!graded && (choice.finest || choice.radius || choice.growth)) {
    refuse("--near", "", "is missing: where edges are --finest");
  }
  if (graded) requirePositive("--finest", *choice.finest);
  fieldOf(choice);
}

MeshSource readFromScene(const MeshChoice& choice) {
  const scene::Scene scene = scene::readScene(start::sceneFile(choice.scene));
  const scene::OrganConfig& organ = scene.organs[organIndex(scene, choice.organ)];
  if (organ.surface.empty()) {
    refuse("--organ", organ.name, "must have a surface; its tetrahedra are used as they are");
  }
  MeshSource source;
  source.surface = scene::readOrganSurface(organ, scene.file, &source.repairs);
  source.meshing = scene::meshingOptions(scene, organ);
  return source;
}

MeshSource readFromFile(const MeshChoice& choice) {
  MeshSource source;
  source.surface = formats::readSurface(choice.surface);
  source.surface.points *= choice.scale.value_or(1.0);
  mesh::checkSize(source.surface.points, choice.surface, "--scale");
  mesh::SurfaceReport report;
  source.surface = mesh::repairSurface(source.surface, choice.surface, &report);
  source.repairs = report.repairs;
  source.meshing.edge_length = fieldOf(choice);
  source.meshing.file = choice.surface;
  return source;
}

}  // namespace

void checkChoice(const MeshChoice& choice) {
  if (choice.surface.empty() == choice.scene.empty()) {
    refuse("", "", "needs either a surface and its --edge-length, or --scene");
  }
  if (choice.scene.empty()) {
    checkFile(choice);
  } else if (choice.edge_length != 0.0 || choice.scale || !choice.near.empty() || choice.finest ||
             choice.radius || choice.growth) {
    refuse("--scene", choice.scene, "has the sizes: give nothing but --organ beside it");
  }
}

MeshSource readMeshSource(const MeshChoice& choice) {
  return choice.scene.empty() ? readFromFile(choice) : readFromScene(choice);
}

}  // namespace palpate::cli
