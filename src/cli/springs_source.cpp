// SPDX-License-Identifier: GPL-3.0-or-later
#include "springs_source.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "options.h"
#include "palpate/base/error.h"
#include "palpate/base/number.h"
#include "palpate/formats/surface_io.h"
#include "palpate/formats/tet_io.h"
#include "palpate/springs/fitted_sheet.h"
#include "palpate/springs/fitted_solid.h"
#include "palpate/springs/spring_grids.h"
#include "palpate/springs/step_bound.h"

namespace palpate::cli {
namespace {

using springs::Constants;

constexpr int kMaxNodes = 2000000;

[[noreturn]] void refuseSprings(const std::string& option, const std::string& value,
                                const std::string& allowed) {
  throw InputError("command line", option, value, allowed);
}

double needed(const char* option, const std::optional<double>& value, const char* what) {
  if (!value) refuseSprings(option, "", std::string("must be given for ") + what);
  requirePositive(option, *value);
  return *value;
}

void unwanted(const char* option, bool given, const char* what) {
  if (given) refuseSprings(option, "", std::string("has no meaning for ") + what);
}

double springsPoissonRatio(const SpringsChoice& choice) {
  if (!choice.poisson_ratio) refuseSprings("--poisson-ratio", "", "must be given for a sheet");
  const double nu = *choice.poisson_ratio;
  if (!(nu > -1.0 && nu < 0.5)) {
    refuseSprings("--poisson-ratio", formatNumber(nu), "must be in (-1, 0.5)");
  }
  return nu;
}

springs::Sheet sheetOf(const SpringsChoice& choice) {
  return {choice.young_modulus, springsPoissonRatio(choice),
          needed("--thickness", choice.thickness, "a sheet")};
}

// So many whole numbers >= 1.
std::vector<int> cellsOf(const SpringsChoice& choice, int wanted) {
  std::vector<int> cells;
  double nodes = 1.0;
  for (std::size_t begin = 0; begin <= choice.cells.size();) {
    const std::size_t comma = std::min(choice.cells.find(',', begin), choice.cells.size());
    const auto n = parseNumber(choice.cells.substr(begin, comma - begin));
    if (!n || *n < 1.0 || *n != std::floor(*n) || *n > kMaxNodes) {
      cells.clear();
      break;
    }
    cells.push_back(static_cast<int>(*n));
    nodes *= *n + 1.0;
    begin = comma + 1;
  }
  if (static_cast<int>(cells.size()) == wanted && nodes <= kMaxNodes) return cells;
  refuseSprings("--cells", choice.cells,
                "must be " + std::to_string(wanted) + " whole numbers >= 1 with commas, with " +
                    std::to_string(kMaxNodes) + " nodes or less");
}

MadeSprings regularSprings(const SpringsChoice& choice) {
  const std::string& kind = *choice.regular;
  const double U = needed("--spacing", choice.spacing, "a regular mesh");
  const Constants constants = choice.printed ? Constants::kPrinted : Constants::kCorrected;
  const bool line = kind == "line", cubes = kind == "cubes", squares = kind == "squares";
  unwanted("--width", choice.width.has_value() && !line, "other than a line");
  unwanted("--poisson-ratio", choice.poisson_ratio.has_value() && (line || cubes),
           "lines and cubes, whose springs choose it");
  unwanted("--thickness", choice.thickness.has_value() && cubes, "cubes");
  unwanted("--diagonals", choice.diagonals.has_value() && !cubes, "other than cubes");
  unwanted("--printed", choice.printed && !(cubes || squares), "lines and triangles");
  MadeSprings made;
  if (line) {
    const double b = needed("--width", choice.width, "a line");
    const double h = needed("--thickness", choice.thickness, "a line");
    const auto beam = springs::rectangularSection(choice.young_modulus, b, h);
    made.network = springs::lineNetwork(springs::lineSprings(beam, U), U, cellsOf(choice, 1)[0] + 1,
                                        choice.density * b * h);
  } else if (cubes) {
    const std::vector<int> n = cellsOf(choice, 3);
    const auto diagonals = choice.diagonals.value_or("faces") == "body"
                               ? springs::CubeDiagonals::kBody
                               : springs::CubeDiagonals::kFaces;
    made.network =
        springs::cubeNetwork(springs::cubeSprings(choice.young_modulus, U, diagonals, constants), U,
                             {n[0], n[1], n[2]}, choice.density);
  } else {
    const springs::Sheet sheet = sheetOf(choice);
    const std::vector<int> n = cellsOf(choice, 2);
    const double areal_density = choice.density * sheet.thickness;
    made.network =
        squares
            ? springs::rectangleNetwork(springs::rectangleSprings(sheet, U, constants), U,
                                        springs::rectangleNodes(n[0] + 1, n[1] + 1), areal_density)
            : springs::triangleNetwork(springs::triangleSprings(sheet, U), U,
                                       springs::triangleNodes(n[0] + 1, n[1] + 1), areal_density);
  }
  return made;
}

bool isSurface(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const char* known : {".obj", ".off", ".stl", ".ply", ".wrl"}) {
    if (extension == known) return true;
  }
  return false;
}

MadeSprings fittedSprings(const SpringsChoice& choice) {
  unwanted("--cells", !choice.cells.empty(), "a file");
  unwanted("--spacing", choice.spacing.has_value(), "a file");
  unwanted("--diagonals", choice.diagonals.has_value(), "a file");
  unwanted("--width", choice.width.has_value(), "a file");
  unwanted("--printed", choice.printed, "a file");
  const springs::FitSettings settings{choice.step.value_or(0.0), choice.match_mean};
  const double scale = choice.scale.value_or(1.0);
  MadeSprings made;
  if (isSurface(choice.mesh)) {
    const springs::Sheet sheet = sheetOf(choice);
    mesh::SurfaceMesh surface = formats::readSurface(choice.mesh);
    surface.points *= scale;
    const springs::SheetFit fit =
        springs::fitSheet(sheet, surface, choice.density * sheet.thickness, {}, settings);
    made = {fit.network, fit.counts, {{"preload", fit.preload}, {"stiffness", fit.stiffness}}};
  } else {
    unwanted("--thickness", choice.thickness.has_value(), "tetrahedra");
    unwanted("--poisson-ratio", choice.poisson_ratio.has_value(),
             "tetrahedra, whose springs have 1/4");
    mesh::TetMesh mesh = formats::readTetMesh(choice.mesh);
    formats::checkTets(mesh, choice.mesh);
    mesh.points *= scale;
    const springs::SolidFit fit =
        springs::fitSolid(mesh, choice.young_modulus, choice.density, settings);
    made = {fit.network, {}, {{"stiffness", fit.stiffness}}};
  }
  return made;
}

// Springs that the bounds of the stiffness hold.
void countBounds(const SpringsChoice& choice, MadeSprings* made) {
  const springs::SpringNetwork& network = made->network;
  Eigen::VectorXd largest;
  if (choice.step) {
    largest = springs::largestStiffness(network.springs, network.masses, *choice.step);
  }
  for (std::size_t i = 0; i < network.springs.size(); ++i) {
    const double k = network.springs[i].stiffness;
    made->slack += k == 0.0;
    made->bounded += choice.step && k > 0.0 && k >= largest[static_cast<Eigen::Index>(i)];
  }
}

}  // namespace

MadeSprings makeSprings(const SpringsChoice& choice) {
  if (choice.mesh.empty() == !choice.regular) {
    refuseSprings("mesh", choice.mesh, "must be a file, or --regular must be given, and not both");
  }
  requirePositive("--young-modulus", choice.young_modulus);
  requirePositive("--density", choice.density);
  if (choice.scale) requirePositive("--scale", *choice.scale);
  if (choice.step) requirePositive("--step", *choice.step);
  unwanted("--scale", choice.scale.has_value() && choice.regular.has_value(), "a regular mesh");
  unwanted("--step", choice.step.has_value() && choice.regular.has_value(),
           "a regular mesh, which has nothing to choose");
  unwanted("--match-mean", choice.match_mean && choice.regular.has_value(),
           "a regular mesh, which has nothing to choose");
  MadeSprings made;
  try {
    made = choice.regular ? regularSprings(choice) : fittedSprings(choice);
  } catch (const std::invalid_argument& e) {
    throw InputError(choice.regular ? "command line" : choice.mesh, "", "", e.what());
  }
  countBounds(choice, &made);
  return made;
}

}  // namespace palpate::cli
