// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/fitted_sheet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <stdexcept>

#include "palpate/mesh/planar_mesh.h"
#include "palpate/springs/network_modes.h"
#include "palpate/springs/network_statics.h"
#include "support/contains.h"
#include "support/random.h"

namespace palpate::springs::fitted_sheet_test {
namespace {

using test::contains;

const Sheet kSheet{1.0e7, 0.3, 0.1};  // N/cm^2, cm: the plates of [Wang 2005, 6.4]

mesh::SurfaceMesh plate(bool hole, double edge_length) {
  mesh::Polygon outline(2, 4);
  outline << 0, 32, 32, 0, 0, 0, 24, 24;
  std::vector<mesh::Polygon> holes;
  if (hole) holes.push_back(mesh::circle({16, 12}, 6.0, edge_length));
  return mesh::meshPolygon(outline, holes, edge_length);
}

// A fan of n triangles around one vertex.
mesh::SurfaceMesh fan(int n) {
  mesh::SurfaceMesh surface;
  surface.points = Points::Zero(3, n + 1);
  surface.triangles.resize(3, n);
  for (int i = 0; i < n; ++i) {
    const double angle = 6.283185307179586 * i / n;
    surface.points.col(i + 1) << std::cos(angle), std::sin(angle), 0.0;
    surface.triangles.col(i) << 0, i + 1, (i + 1) % n + 1;
  }
  return surface;
}

// n x n equilateral triangles' worth of nodes.
mesh::SurfaceMesh regular(int columns, int rows, double U) {
  mesh::SurfaceMesh surface;
  surface.points = Points::Zero(3, Eigen::Index{columns} * rows);
  std::vector<Eigen::Vector3i> triangles;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const int at = j * columns + i;
      surface.points.col(at) << (i + 0.5 * (j % 2)) * U, 0.5 * std::sqrt(3.0) * j * U, 0.0;
      if (i + 1 == columns || j + 1 == rows) continue;
      const int above = at + columns;
      if (j % 2 == 0) {
        triangles.emplace_back(at, at + 1, above);
        triangles.emplace_back(at + 1, above + 1, above);
      } else {
        triangles.emplace_back(at, above + 1, above);
        triangles.emplace_back(at, at + 1, above + 1);
      }
    }
  }
  surface.triangles.resize(3, static_cast<Eigen::Index>(triangles.size()));
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    surface.triangles.col(static_cast<Eigen::Index>(t)) = triangles[t];
  }
  return surface;
}

const ConstraintFamily& family(const std::vector<ConstraintFamily>& all, const std::string& name) {
  for (const ConstraintFamily& f : all) {
    if (f.name == name) return f;
  }
  throw std::invalid_argument("no family " + name);
}

TEST(SheetTopology, ValenceThreeAndFourHaveFewerFlexionSprings) {
  const auto flexions = [](const SheetTopology& sheet) {
    int count = 0;
    for (const Spring& s : sheet.springs) count += s.kind == SpringKind::kFlexion;
    return count;
  };
  for (const auto& [n, flexion] : {std::pair{3, 0}, {4, 2}, {5, 5}, {6, 6}, {7, 7}}) {
    const mesh::SurfaceMesh surface = fan(n);
    const SheetTopology sheet = sheetTopology(surface.points, surface.triangles);
    EXPECT_EQ(flexions(sheet), flexion) << n;
    EXPECT_EQ(sheet.counts.springs, 2 * n + flexion);
    EXPECT_EQ(sheet.counts.springs, sheet.counts.expectedSprings());
    EXPECT_EQ(sheet.counts.boundary_vertices, n);
    EXPECT_EQ(sheet.counts.valence_3, n == 3);
    EXPECT_EQ(sheet.counts.valence_4, n == 4);
  }
}

// N_t = 2 (N_v + N_h - 1) - N_b (6.102) and N_s = 3 N_t - 3 N_3 - 2 N_4 (6.100).
TEST(SheetTopology, CountsOfPlates) {
  for (const bool hole : {false, true}) {
    for (const double edge : {3.0, 2.0, 1.2}) {
      const mesh::SurfaceMesh surface = plate(hole, edge);
      const SheetCounts counts = sheetTopology(surface.points, surface.triangles).counts;
      EXPECT_EQ(counts.triangles, 2 * (counts.vertices + hole - 1) - counts.boundary_vertices);
      EXPECT_EQ(counts.springs, counts.expectedSprings()) << hole << " " << edge;
    }
  }
}

TEST(SheetTopology, RefusesSheetsThatAreNone) {
  const auto refusal = [](auto&& change) {
    mesh::SurfaceMesh surface = fan(5);
    change(surface);
    try {
      sheetTopology(surface.points, surface.triangles);
    } catch (const std::invalid_argument& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_TRUE(contains(refusal([](auto& s) { s.points.col(2) = s.points.col(1); }),
                       "triangle 0: is collapsed"));
  EXPECT_TRUE(contains(refusal([](auto& s) { s.triangles(1, 3) = 9; }), "triangle 3: a corner"));
  EXPECT_TRUE(contains(refusal([](auto& s) { s.triangles.col(3) << 2, 0, 4; }),
                       "has two triangles already"));
  EXPECT_TRUE(contains(refusal([](auto& s) { s.triangles.col(3).reverseInPlace(); }),
                       "turns the other way than its neighbour"));
  EXPECT_TRUE(contains(refusal([](auto& s) { s.triangles.col(3) = s.triangles.col(0); }),
                       "triangle 3: turns the other way than its neighbour, or is there twice"));
  EXPECT_TRUE(contains(refusal([](auto& s) {
                         s.points.conservativeResize(3, 7);
                         s.points.col(6).setConstant(3.0);
                       }),
                       "point 6: is in no triangle"));
}

// Inside a regular mesh every condition can be met, and is, far from the edges.
TEST(FittedSheet, RegularTrianglesMeetTheirConditionsInside) {
  const Sheet third{1.0e7, 1.0 / 3.0, 0.1};
  const int n = 25;
  const mesh::SurfaceMesh surface = regular(n, n, 2.0);
  const SheetFit fit = fitSheet(third, surface, 1.0);
  double bending = 0.0, stretch = 0.0;
  const int middle = (n / 2) * n + n / 2;
  for (const Spring& s : fit.network.springs) {
    if (s.a != middle && s.b != middle) continue;
    bending += s.preload * std::pow(s.length, 3);
    stretch += s.stiffness * s.length * s.length;
  }
  const double A = fit.network.masses[middle];  // areal density 1
  EXPECT_NEAR(bending / (-64 * third.bendingStiffness() * A), 1.0, 0.02);
  EXPECT_NEAR(stretch / (6 * third.young_modulus * third.thickness * A), 1.0, 0.02);
}

TEST(FittedSheet, PreloadsBalanceAndDoNotDependOnTheFrame) {
  test::Random random;
  const mesh::SurfaceMesh surface = plate(true, 3.0);
  const SheetFit fit = fitSheet(kSheet, surface, 0.5);
  EXPECT_NO_THROW(checkNetwork(fit.network));
  double largest = 0.0;
  for (const Spring& s : fit.network.springs) largest = std::max(largest, std::abs(s.preload));
  EXPECT_LT(networkForces(fit.network, surface.points).cwiseAbs().maxCoeff(), 1e-10 * largest);
  EXPECT_LT(family(fit.preload, "balance").worst, 1e-10);

  mesh::SurfaceMesh turned = surface;
  turned.points = (random.rotation() * surface.points).colwise() + random.vector(10.0);
  const SheetFit again = fitSheet(kSheet, turned, 0.5);
  ASSERT_EQ(again.network.springs.size(), fit.network.springs.size());
  const double stiff = kSheet.young_modulus * kSheet.thickness;
  for (std::size_t i = 0; i < fit.network.springs.size(); ++i) {
    EXPECT_NEAR(again.network.springs[i].preload, fit.network.springs[i].preload, 1e-6 * largest);
    EXPECT_NEAR(again.network.springs[i].stiffness, fit.network.springs[i].stiffness, 1e-6 * stiff);
  }
}

// The residuals are those that the springs have: (6.81) of one point by hand.
TEST(FittedSheet, ResidualsAreThoseOfTheSprings) {
  const mesh::SurfaceMesh surface = plate(false, 2.5);
  const SheetFit fit = fitSheet(kSheet, surface, 1.0);
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(surface.points.cols());
  for (const Spring& s : fit.network.springs) {
    EXPECT_GE(s.stiffness, 0.0);
    sums[s.a] += s.stiffness * s.length * s.length;
    sums[s.b] += s.stiffness * s.length * s.length;
  }
  const Eigen::VectorXd wanted = 6 * kSheet.young_modulus * kSheet.thickness * fit.network.masses;
  const Eigen::VectorXd error = (sums - wanted).cwiseQuotient(wanted);
  const ConstraintFamily& stretch = family(fit.stiffness, "stretch");
  EXPECT_NEAR(stretch.worst, error.cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_NEAR(stretch.rms, error.norm() / std::sqrt(double(error.size())), 1e-10);
  EXPECT_NEAR(stretch.scale, wanted.mean(), 1e-10 * wanted.mean());
}

TEST(FittedSheet, PlatesDoNotBuckleByThemselves) {
  for (const double edge : {3.5, 2.7, 2.0}) {
    for (const mesh::SurfaceMesh& surface :
         {plate(false, edge), plate(true, edge),
          mesh::meshPolygon(mesh::circle({0, 0}, 16.0, edge), {}, edge)}) {
      const NetworkModes modes = networkModes(fitSheet(kSheet, surface, 1.0).network);
      EXPECT_EQ(modes.falling, 0) << edge;
      EXPECT_EQ(modes.neutral, 6) << edge;
    }
  }
}

TEST(FittedSheet, MatchedMeansAreThoseOfTheSheet) {
  const mesh::SurfaceMesh surface = plate(true, 2.5);
  const SheetFit fit = fitSheet(kSheet, surface, 1.0, {}, {0.0, true});
  const double area = fit.network.masses.sum();
  double bending = 0.0, stretch = 0.0;
  for (const Spring& s : fit.network.springs) {
    bending += 2 * s.preload * std::pow(s.length, 3);
    stretch += 2 * s.stiffness * s.length * s.length;
  }
  const double right = -64 * kSheet.bendingStiffness() * area;
  EXPECT_NEAR(bending, right, -1e-9 * right);
  EXPECT_NEAR(stretch, 6 * kSheet.young_modulus * kSheet.thickness * area, 1e-9 * stretch);
  EXPECT_LT(networkForces(fit.network, surface.points).cwiseAbs().maxCoeff(), 1e-8);
}

/// A plate of 32 x 24 cm, clamped at one short end, under 1 N at a corner of the other, or 0.002
/// N/cm^2 all over [Wang 2005, 6.4.1]. It goes on for 4 cm behind the held line: so it is clamped
/// there and not hinged.
struct Cantilever {
  SpringNetwork network;
  NetworkLoads corner_force, pressure;
  Eigen::Index corner = -1;

  Cantilever(SpringNetwork given, double areal_density) : network(std::move(given)) {
    corner_force = pressure = noLoads(network);
    const Points& X = network.points;
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
      if ((X.col(i) - Vec3(32, 24, 0)).norm() < 1e-6) corner = i;
      if (X(0, i) <= 1e-6) {
        corner_force.free.col(i).setZero();
        pressure.free.col(i).setZero();
      }
    }
    corner_force.forces(2, corner) = 1.0;
    pressure.forces.row(2) = 0.002 / areal_density * network.masses.transpose();
  }

  // Of the corner under the load, without and with large displacements [cm].
  double linear(const NetworkLoads& loads) const {
    const auto moved =
        linearDisplacements(network, network.points, loads, Points::Zero(3, network.points.cols()));
    return moved ? (*moved)(2, corner) : 0.0;
  }
  double nonlinear(const NetworkLoads& loads) const {
    Points x = network.points;
    const NetworkStaticsReport report = solveNetwork(network, loads, {1e-7}, &x);
    EXPECT_EQ(report.status, solver::SolveStatus::kConverged);
    return x(2, corner);
  }
};

Cantilever fittedCantilever(bool hole, double edge, bool match_mean = false) {
  mesh::Polygon outline(2, 6);
  outline << -4, 0, 32, 32, 0, -4, 0, 0, 0, 24, 24, 24;
  std::vector<mesh::Polygon> holes;
  if (hole) holes.push_back(mesh::circle({16, 12}, 6.0, edge));
  const SheetFit fit =
      fitSheet(kSheet, mesh::meshPolygon(outline, holes, edge), 1.0, {}, {0.0, match_mean});
  for (const auto& families : {fit.preload, fit.stiffness}) {
    for (const ConstraintFamily& f : families) {
      std::cout << (hole ? "hole  " : "whole ") << f.name << " rms " << f.rms << ", worst "
                << f.worst << "\n";
    }
  }
  return Cantilever(fit.network, 1.0);
}

// B13 and B14. A plate deflects less than a beam of its section that is bent, and twisted by a
// force at its corner, and no less than one with D in place of E I over its width. Fitted plates
// bend with 0.71 to 0.95 of their stiffness.
TEST(FittedSheet, PlatesBendAsTheirStiffnessSays) {
  const double L = 32.0, b = 24.0, h = kSheet.thickness, E = kSheet.young_modulus;
  const double EI = E * b * h * h * h / 12, GJ = E / 2.6 * b * h * h * h / 3, thin = 1 - 0.09;
  const double bent = L * L * L / (3 * EI), twisted = 0.25 * b * b * L / GJ;
  const double pressed = 0.002 * b * L * L * L * L / (8 * EI);
  EXPECT_NEAR(bent, 0.546, 0.0005);
  EXPECT_NEAR(pressed, 0.315, 0.0005);
  const Cantilever plate = fittedCantilever(false, 2.0);
  EXPECT_GT(plate.linear(plate.corner_force), thin * bent / 0.95);
  EXPECT_LT(plate.linear(plate.corner_force), (bent + twisted) / 0.71);
  EXPECT_GT(plate.linear(plate.pressure), thin * pressed / 0.95);
  EXPECT_LT(plate.linear(plate.pressure), pressed / 0.71);
}

// B13 to B16.
TEST(FittedSheet, PlatesComeToRestUnderLargeDeflections) {
  for (const auto& [hole, matched] :
       {std::pair{false, false}, {true, false}, {false, true}, {true, true}}) {
    const Cantilever plate = fittedCantilever(hole, 2.0, matched);
    for (const NetworkLoads& loads : {plate.corner_force, plate.pressure}) {
      const double linear = plate.linear(loads), w = plate.nonlinear(loads);
      std::cout << (hole ? "hole " : "whole ") << (matched ? "matched " : "") << "linear " << linear
                << " cm, large " << w << " cm\n";
      EXPECT_GT(w, 0.0);
      EXPECT_LT(w, linear);
    }
  }
}

}  // namespace
}  // namespace palpate::springs::fitted_sheet_test
