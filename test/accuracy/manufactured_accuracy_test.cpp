// SPDX-License-Identifier: GPL-3.0-or-later
// Convergence to a manufactured solution: a displacement is chosen, the body force that it needs
// follows from the law, and each element has to find it again, faster with every refinement.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "palpate/fem/elasticity.h"
#include "palpate/fem/loads.h"
#include "palpate/solver/static_solver.h"
#include "support/accuracy_record.h"
#include "support/law_response.h"

namespace palpate {
namespace {

const material::Material kLaw =
    material::makeMaterial("neo_hookean", {{"young_modulus", {1.0}}, {"poisson_ratio", {0.45}}});
constexpr double kAmplitude = 0.06;

// On the unit cube; the largest principal strain is beyond 20 %.
Vec3 displacement(const Vec3& X) {
  const double x = M_PI * X.x(), y = M_PI * X.y(), z = M_PI * X.z();
  return kAmplitude * Vec3(std::sin(x) * std::cos(0.5 * y) + std::sin(y),
                           std::sin(z) * std::cos(0.5 * x) + 0.5 * std::sin(x),
                           std::cos(0.5 * z) * std::sin(x) * std::sin(y));
}

Mat3 deformationGradient(const Vec3& X) {
  const double x = M_PI * X.x(), y = M_PI * X.y(), z = M_PI * X.z();
  Mat3 G;
  G << std::cos(x) * std::cos(0.5 * y), -0.5 * std::sin(x) * std::sin(0.5 * y) + std::cos(y), 0.0,
      -0.5 * std::sin(z) * std::sin(0.5 * x) + 0.5 * std::cos(x), 0.0,
      std::cos(z) * std::cos(0.5 * x), std::cos(0.5 * z) * std::cos(x) * std::sin(y),
      std::cos(0.5 * z) * std::sin(x) * std::cos(y),
      -0.5 * std::sin(0.5 * z) * std::sin(x) * std::sin(y);
  return Mat3::Identity() + kAmplitude * M_PI * G;
}

// -Div P by differences of fourth order.
Vec3 bodyForce(const Vec3& X) {
  constexpr double h = 2e-3;
  const auto column = [&](int j, double s) -> Vec3 {
    const Mat3 F = deformationGradient(X + s * h * Vec3::Unit(j));
    return test::firstPiolaKirchhoff(kLaw, F).col(j);
  };
  Vec3 divergence = Vec3::Zero();
  for (int j = 0; j < 3; ++j) {
    divergence +=
        (8.0 * (column(j, 1) - column(j, -1)) - (column(j, 2) - column(j, -2))) / (12.0 * h);
  }
  return -divergence;
}

// Gauss points of a cube, folded into a tetrahedron: exact for polynomials of degree 5.
struct RulePoint {
  Eigen::Vector4d w;
  double weight;  // of the unit volume
};
std::vector<RulePoint> tetrahedronRule() {
  const double points[4] = {0.06943184420297371, 0.33000947820757187, 0.6699905217924281,
                            0.9305681557970262};
  const double weights[4] = {0.17392742256872692, 0.3260725774312731, 0.3260725774312731,
                             0.17392742256872692};
  std::vector<RulePoint> rule;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      for (int k = 0; k < 4; ++k) {
        const double a = points[i], b = (1 - a) * points[j], c = (1 - a - b) * points[k];
        const double jacobian = (1 - a) * (1 - a - b);
        rule.push_back(
            {{a, b, c, 1 - a - b - c}, 6 * jacobian * weights[i] * weights[j] * weights[k]});
      }
    }
  }
  return rule;
}
const std::vector<RulePoint> kRule = tetrahedronRule();

struct Errors {
  double l2, energy;  // of the displacement, and of its gradient
};

// A straight-edged mesh: places in it are linear in the barycentric coordinates.
Vec3 place(const mesh::TetMesh& mesh, const mesh::Location& at) {
  Vec3 X = Vec3::Zero();
  for (int a = 0; a < 4; ++a) X += at.w[a] * mesh.points.col(mesh.tets(a, at.tet));
  return X;
}

Points loads(const mesh::TetMesh& mesh) {
  Points forces = Points::Zero(3, mesh.numPoints());
  for (int e = 0; e < mesh.numTets(); ++e) {
    const double volume = mesh::signedVolume(mesh.points, mesh.tets.col(e));
    for (const RulePoint& q : kRule) {
      const mesh::Location at{e, q.w};
      const Vec3 force = q.weight * volume * bodyForce(place(mesh, at));
      for (const auto& [node, N] : mesh::shapeValues(mesh, at)) forces.col(node) += N * force;
    }
  }
  return forces;
}

Errors errors(const mesh::TetMesh& mesh, fem::Elasticity* body, const Points& x) {
  double l2 = 0.0, gradient = 0.0;
  std::vector<mesh::Location> places;
  for (int e = 0; e < mesh.numTets(); ++e) {
    for (const RulePoint& q : kRule) places.push_back({e, q.w});
  }
  const std::vector<fem::PointState> states = body->states(x, places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec3 X = place(mesh, places[i]);
    const double volume = mesh::signedVolume(mesh.points, mesh.tets.col(places[i].tet)) *
                          kRule[i % kRule.size()].weight;
    l2 += volume *
          (mesh::interpolate(mesh, places[i], x - mesh.points) - displacement(X)).squaredNorm();
    gradient += volume * (states[i].F - deformationGradient(X)).squaredNorm();
  }
  return {std::sqrt(l2), std::sqrt(gradient)};
}

Errors solve(const std::string& element, int cells) {
  const mesh::TetMesh mesh =
      fem::meshFor(element, mesh::boxMesh(Vec3::Ones(), Eigen::Vector3i::Constant(cells)));
  const auto body = fem::makeElasticity(element, mesh, fem::Composition::uniform(kLaw));
  fem::DeadLoad load(loads(mesh));
  fem::FreeMask free = fem::FreeMask::Ones(3, mesh.numPoints());
  Points exact = mesh.points;
  for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
    const Vec3 X = mesh.points.col(i);
    exact.col(i) += displacement(X);
    if ((X.array() < 1e-12).any() || (X.array() > 1 - 1e-12).any()) free.col(i).setZero();
  }
  Points x = mesh.points;
  const solver::StaticReport report = solver::solveStatic(
      {body.get(), {&load}, free, 1.0},
      [&](double s) -> Points {
        load.setFactor(s);
        return (1 - s) * mesh.points + s * exact;
      },
      {2, 1e-10, 50}, &x);
  EXPECT_EQ(report.status, solver::SolveStatus::kConverged) << element << " " << cells;
  return errors(mesh, body.get(), x);
}

// An order that is lost shows as 1; on meshes this coarse the next term of the error shows as well.
constexpr double kMostOff = 0.2;

struct Expected {
  const char* element;
  int coarse, fine;
  double l2_order, energy_order;
};

class ManufacturedSolution : public ::testing::TestWithParam<Expected> {};

TEST_P(ManufacturedSolution, ConvergesAtTheElementsOrder) {
  const Expected& expected = GetParam();
  const Errors coarse = solve(expected.element, expected.coarse);
  const Errors fine = solve(expected.element, expected.fine);
  const double refinement = std::log(static_cast<double>(expected.fine) / expected.coarse);
  const std::string mesh = std::to_string(expected.coarse) + "^3 and " +
                           std::to_string(expected.fine) + "^3 cells, 6 tetrahedra each";
  const auto record = [&](const char* norm, double order, double reference, double size) {
    test::recordAccuracy({"Manufactured solution", mesh, expected.element,
                          std::string("order of the ") + norm + " (error on the fine mesh " +
                              std::to_string(1e3 * size) + "e-3)",
                          order, reference, "theory: Ciarlet 1978, theorem 3.2.5",
                          std::abs(order - reference), kMostOff});
  };
  record("L2 norm", std::log(coarse.l2 / fine.l2) / refinement, expected.l2_order, fine.l2);
  record("energy norm", std::log(coarse.energy / fine.energy) / refinement, expected.energy_order,
         fine.energy);
}

// The lumped pressures of tet10p change the volumetric energy by a part of the order of the mesh
// size squared, and with it displacements: of their third order the second is left.
INSTANTIATE_TEST_SUITE_P(Elements, ManufacturedSolution,
                         ::testing::Values(Expected{"tet4", 8, 12, 2.0, 1.0},
                                           Expected{"anp", 8, 12, 2.0, 1.0},
                                           Expected{"p1p1", 8, 12, 2.0, 1.0},
                                           Expected{"tet10", 4, 6, 3.0, 2.0},
                                           Expected{"tet10p", 4, 6, 2.0, 2.0}),
                         [](const auto& element) { return element.param.element; });

TEST(ManufacturedSolutionItself, StrainsByMoreThanAFifth) {
  double largest = 0.0;
  for (int i = 0; i <= 20; ++i) {
    for (int j = 0; j <= 20; ++j) {
      const Mat3 F = deformationGradient(Vec3(i / 20.0, j / 20.0, 0.3));
      largest = std::max(largest, Eigen::JacobiSVD<Mat3>(F).singularValues()[0] - 1.0);
    }
  }
  EXPECT_GT(largest, 0.2);
}

TEST(ManufacturedSolutionItself, HasTheGradientThatIsClaimed) {
  constexpr double h = 1e-6;
  const Vec3 X(0.3, 0.45, 0.8);
  for (int j = 0; j < 3; ++j) {
    const Vec3 slope =
        (displacement(X + h * Vec3::Unit(j)) - displacement(X - h * Vec3::Unit(j))) / (2 * h);
    EXPECT_LT((deformationGradient(X).col(j) - Vec3::Unit(j) - slope).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace palpate
