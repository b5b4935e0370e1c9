// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/fitted_sheet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <stdexcept>

#include "palpate/mesh/planar_mesh.h"
#include "palpate/springs/network_modes.h"
#include "palpate/springs/network_statics.h"
#include "palpate/springs/spring_grids.h"
#include "support/contains.h"
#include "support/random.h"

namespace palpate::springs {
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
  EXPECT_TRUE(contains(refusal([](auto& s) { s.triangles.col(3) = s.triangles.col(0); }),
                       "has two triangles already"));
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

// The plates of B13 and B15: held at one short end, 1 N at a corner of the other. The mesh goes on
// for 4 cm behind the held line, so that the sheet is clamped there and not hinged.
struct Cantilever {
  SheetFit fit;
  NetworkLoads loads;
  Eigen::Index corner = -1;

  explicit Cantilever(bool hole) : fit(fitSheet(kSheet, mesh(hole), 1.0)) {
    loads = noLoads(fit.network);
    const Points& X = fit.network.points;
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
      if (X(0, i) <= 1e-9) loads.free.col(i).setZero();
      if ((X.col(i) - Vec3(32, 24, 0)).norm() < 1e-9) corner = i;
    }
    loads.forces(2, corner) = 1.0;
  }

  static mesh::SurfaceMesh mesh(bool hole) {
    mesh::Polygon outline(2, 6);
    outline << -4, 0, 32, 32, 0, -4, 0, 0, 0, 24, 24, 24;
    std::vector<mesh::Polygon> holes;
    if (hole) holes.push_back(mesh::circle({16, 12}, 6.0, 2.0));
    return mesh::meshPolygon(outline, holes, 2.0);
  }
};

TEST(FittedSheet, PlatesComeToRestUnderAForceAtACorner) {
  for (const bool hole : {false, true}) {
    const Cantilever plate(hole);
    for (const auto& families : {plate.fit.preload, plate.fit.stiffness}) {
      for (const ConstraintFamily& f : families) {
        std::cout << (hole ? "hole  " : "whole ") << f.name << " rms " << f.rms << " worst "
                  << f.worst << "\n";
      }
    }
    const SpringNetwork& network = plate.fit.network;
    const auto linear = linearDisplacements(network, network.points, plate.loads,
                                            Points::Zero(3, network.points.cols()));
    ASSERT_TRUE(linear) << hole;
    Points x = network.points;
    const NetworkStaticsReport report = solveNetwork(network, plate.loads, {1e-7}, &x);
    std::cout << "linear " << (*linear)(2, plate.corner) << " cm, nonlinear " << x(2, plate.corner)
              << " cm after " << report.iterations << " iterations\n";
    EXPECT_EQ(report.status, solver::SolveStatus::kConverged);
  }
}

}  // namespace
}  // namespace palpate::springs
