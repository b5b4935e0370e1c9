// SPDX-License-Identifier: GPL-3.0-or-later
#include "sheet_network.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "palpate/base/number.h"
#include "palpate/springs/fitted_sheet.h"
#include "palpate/springs/lumped_mass.h"
#include "palpate/springs/spring_grids.h"
#include "palpate/springs/springs_file.h"

namespace palpate::tissue {
namespace {

constexpr double kLargestGrid = 1e5;  // points
// Of the mesh's size: so far may points of a file be from the sheet's.
constexpr double kSamePoint = 1e-3;

springs::Sheet plateOf(const material::Solid& solid, double thickness) {
  const material::Moduli m = material::moduli(solid.law);
  const double E = 9.0 * m.kappa * m.mu / (3.0 * m.kappa + m.mu);
  const double nu = (3.0 * m.kappa - 2.0 * m.mu) / (6.0 * m.kappa + 2.0 * m.mu);
  return {E, nu, thickness};
}

void check(const OrganDescription& organ) {
  const ClothSettings& cloth = organ.cloth;
  if (!(cloth.thickness > 0.0)) {
    throw std::invalid_argument("cloth.thickness = " + formatNumber(cloth.thickness) +
                                ": must be > 0 [m]");
  }
  if (cloth.made() == static_cast<bool>(organ.sheet)) {
    throw std::invalid_argument(
        "model cloth needs either a surface or cloth.width, .length and "
        ".spacing; it takes no tetrahedra");
  }
  if (!cloth.made()) return;
  const double shorter = std::min(cloth.width, cloth.length);
  if (!(cloth.spacing > 0.0 && 2.0 * cloth.spacing <= shorter)) {
    throw std::invalid_argument("cloth.spacing = " + formatNumber(cloth.spacing) +
                                ": must be > 0 and at most half of width and length, " +
                                formatNumber(0.5 * shorter));
  }
  if (cloth.width * cloth.length > kLargestGrid * cloth.spacing * cloth.spacing) {
    throw std::invalid_argument("cloth.spacing = " + formatNumber(cloth.spacing) +
                                ": would make more than 100000 points; must be larger");
  }
}

// Node (i, j) of the rows is number j * columns + i.
Eigen::Matrix3Xi gridTriangles(int columns, int rows) {
  Eigen::Matrix3Xi triangles(3, 2 * (columns - 1) * (rows - 1));
  Eigen::Index t = 0;
  for (int j = 0; j + 1 < rows; ++j) {
    for (int i = 0; i + 1 < columns; ++i) {
      const int a = j * columns + i, b = a + 1, c = a + columns, d = c + 1;
      // Odd rows are half a spacing to the right.
      if (j % 2 == 0) {
        triangles.col(t++) << a, b, c;
        triangles.col(t++) << b, d, c;
      } else {
        triangles.col(t++) << a, d, c;
        triangles.col(t++) << a, b, d;
      }
    }
  }
  return triangles;
}

double rowHeight(const ClothSettings& cloth) { return 0.5 * std::sqrt(3.0) * cloth.spacing; }

int numColumns(const ClothSettings& cloth) {
  return static_cast<int>(std::lround(cloth.width / cloth.spacing)) + 1;
}

int numRows(const ClothSettings& cloth) {
  return static_cast<int>(std::lround(cloth.length / rowHeight(cloth))) + 1;
}

mesh::SurfaceMesh gridOf(const ClothSettings& cloth) {
  const int columns = numColumns(cloth), rows = numRows(cloth);
  mesh::SurfaceMesh grid{Points::Zero(3, columns * rows), gridTriangles(columns, rows)};
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      grid.points.col(j * columns + i) << (i + 0.5 * (j % 2)) * cloth.spacing, j * rowHeight(cloth),
          0.0;
    }
  }
  return grid;
}

springs::SpringNetwork regular(const springs::Sheet& plate, const ClothSettings& cloth,
                               double areal_density) {
  return springs::triangleNetwork(springs::triangleSprings(plate, cloth.spacing), cloth.spacing,
                                  springs::triangleNodes(numColumns(cloth), numRows(cloth)),
                                  areal_density);
}

std::string describe(const springs::SheetFit& fit) {
  std::ostringstream text;
  text.precision(2);
  text << fit.network.springs.size() << " springs fitted";
  for (const auto* families : {&fit.preload, &fit.stiffness}) {
    for (const springs::ConstraintFamily& family : *families) {
      text << ", " << family.name << " within " << 100.0 * family.rms << " %";
    }
  }
  text << " (rms)";
  return text.str();
}

springs::SpringNetwork fitted(const springs::Sheet& plate, const mesh::SurfaceMesh& surface,
                              double areal_density, std::vector<std::string>* notes) {
  springs::FitSettings right_mean;
  right_mean.match_mean = true;
  const springs::SheetFit fit = springs::fitSheet(plate, surface, areal_density, {}, right_mean);
  notes->push_back(describe(fit));
  return fit.network;
}

springs::SpringNetwork fromFile(const std::string& file, const Points& points) {
  springs::SpringNetwork network = springs::readSprings(file);
  const double size = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
  if (network.points.cols() != points.cols() ||
      (network.points - points).colwise().norm().maxCoeff() > kSamePoint * size) {
    throw std::invalid_argument("springs.file = " + file +
                                ": its points must be those of the sheet, " +
                                std::to_string(points.cols()));
  }
  return network;
}

void dropPreload(springs::SpringNetwork* network) {
  std::vector<springs::Spring>& springs = network->springs;
  for (springs::Spring& spring : springs) spring.preload = 0.0;
  springs.erase(std::remove_if(springs.begin(), springs.end(),
                               [](const springs::Spring& s) {
                                 return s.stiffness == 0.0 && s.damping == 0.0;
                               }),
                springs.end());
}

}  // namespace

SheetNetwork sheetNetwork(const OrganDescription& organ, const material::Solid& solid,
                          std::vector<std::string>* notes) {
  check(organ);
  const ClothSettings& cloth = organ.cloth;
  const mesh::SurfaceMesh surface = cloth.made() ? gridOf(cloth) : organ.sheet();
  const springs::Sheet plate = plateOf(solid, cloth.thickness);
  const double areal_density = solid.density * cloth.thickness;
  SheetNetwork sheet{{}, surface.triangles};
  if (organ.springs.constants == "file") {
    sheet.network = fromFile(organ.springs.file, surface.points);
  } else if (cloth.made() && organ.springs.constants != "fitted") {
    sheet.network = regular(plate, cloth, areal_density);
  } else {
    sheet.network = fitted(plate, surface, areal_density, notes);
  }
  sheet.network.masses = areal_density * springs::triangleShares(surface.points, surface.triangles);
  if (!cloth.preload) dropPreload(&sheet.network);
  return sheet;
}

}  // namespace palpate::tissue
