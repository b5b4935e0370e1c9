// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/fitted_sheet.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "conditions.h"
#include "palpate/springs/lumped_mass.h"
#include "palpate/springs/step_bound.h"

namespace palpate::springs {
namespace {

// A spring as seen from one of its masses.
struct Arm {
  Eigen::Index spring;
  double U;               // length [m]
  Vec3 e;                 // away from the mass
  double s2, c2, s4, c4;  // sine, cosine of 2 and 4 times its angle in the tangent plane
};

Points normals(const mesh::SurfaceMesh& surface) {
  Points normals = Points::Zero(3, surface.points.cols());
  for (Eigen::Index t = 0; t < surface.triangles.cols(); ++t) {
    const Eigen::Vector3i corners = surface.triangles.col(t);
    const Vec3 p = surface.points.col(corners[0]), q = surface.points.col(corners[1]),
               r = surface.points.col(corners[2]);
    for (int k = 0; k < 3; ++k) normals.col(corners[k]) += (q - p).cross(r - p);
  }
  return normals;
}

Arm arm(Eigen::Index spring, const Vec3& d, const Vec3& normal) {
  const Vec3 n = normal.normalized();
  // Axis of the tangent plane, equal at all points of a flat sheet.
  int least = 0;
  n.cwiseAbs().minCoeff(&least);
  const Vec3 axis = n.cross(Vec3::Unit(least)).normalized();
  const double angle = std::atan2(n.cross(axis).dot(d), axis.dot(d));
  return {spring,
          d.norm(),
          d.normalized(),
          std::sin(2 * angle),
          std::cos(2 * angle),
          std::sin(4 * angle),
          std::cos(4 * angle)};
}

std::vector<std::vector<Arm>> armsOf(const SpringNetwork& network,
                                     const mesh::SurfaceMesh& surface) {
  const Points normal = normals(surface);
  std::vector<std::vector<Arm>> arms(static_cast<std::size_t>(network.points.cols()));
  for (std::size_t i = 0; i < network.springs.size(); ++i) {
    const Spring& s = network.springs[i];
    const Vec3 d = network.points.col(s.b) - network.points.col(s.a);
    const auto index = static_cast<Eigen::Index>(i);
    arms[static_cast<std::size_t>(s.a)].push_back(arm(index, d, normal.col(s.a)));
    arms[static_cast<std::size_t>(s.b)].push_back(arm(index, -d, normal.col(s.b)));
  }
  return arms;
}

double meanSquareEdge(const std::vector<Spring>& springs) {
  double sum = 0.0, count = 0.0;
  for (const Spring& s : springs) {
    if (s.kind != SpringKind::kStructural) continue;
    sum += s.length * s.length;
    ++count;
  }
  return sum / count;
}

// Adds a condition of a family at one mass: `factor(arm)` for each spring.
template <class F>
void addCondition(const std::vector<Arm>& arms, std::size_t family, double scale, double right,
                  const F& factor, Conditions* conditions) {
  conditions->begin(family, scale, right);
  for (const Arm& a : arms) conditions->add(a.spring, factor(a));
}

Eigen::VectorXd fitPreload(const Sheet& sheet, const std::vector<std::vector<Arm>>& arms,
                           const Eigen::VectorXd& areas, double square, const SheetWeights& weights,
                           Eigen::Index count, bool match_mean,
                           std::vector<ConstraintFamily>* families) {
  const auto& w = weights.of_preload;
  Conditions hard(count), soft(count);
  const auto balance = hard.addFamily("balance");
  const auto tension = soft.addFamily("no_tension", w[0]), shear = soft.addFamily("no_shear", w[1]),
             twofold = soft.addFamily("bending_2", w[2]),
             fourfold = soft.addFamily("bending_4", w[3]),
             bending = soft.addFamily("bending", w[4]);
  for (std::size_t m = 0; m < arms.size(); ++m) {
    // 64 D A: E A h^3 16/(3 (1 - nu^2)).
    const double S = 64.0 * sheet.bendingStiffness() * areas[static_cast<Eigen::Index>(m)];
    const auto add = [&](std::size_t family, double scale, double right, auto&& factor) {
      addCondition(arms[m], family, scale, right, factor, &soft);
    };
    for (int c = 0; c < 3; ++c) {
      addCondition(
          arms[m], balance, S / (square * std::sqrt(square)), 0.0,
          [&](const Arm& a) { return a.e[c]; }, &hard);
    }
    add(tension, S / square, 0.0, [](const Arm& a) { return a.U; });
    add(shear, S / square, 0.0, [](const Arm& a) { return a.U * a.s2; });
    add(shear, S / square, 0.0, [](const Arm& a) { return a.U * a.c2; });
    add(twofold, S, 0.0, [](const Arm& a) { return a.U * a.U * a.U * a.s2; });
    add(twofold, S, 0.0, [](const Arm& a) { return a.U * a.U * a.U * a.c2; });
    add(fourfold, S, 0.0, [](const Arm& a) { return a.U * a.U * a.U * a.s4; });
    add(fourfold, S, 0.0, [](const Arm& a) { return a.U * a.U * a.U * a.c4; });
    add(bending, S, -S, [](const Arm& a) { return a.U * a.U * a.U; });
  }
  Eigen::VectorXd P = equalityLeastSquares(soft.matrix(), soft.right(), hard.matrix());
  if (match_mean) P *= soft.matchingFactor(bending, P);
  *families = hard.residuals(P);
  for (const ConstraintFamily& family : soft.residuals(P)) families->push_back(family);
  return P;
}

Eigen::VectorXd fitStiffness(const Sheet& sheet, const std::vector<std::vector<Arm>>& arms,
                             const Eigen::VectorXd& areas, const Eigen::VectorXd& P,
                             const SheetWeights& weights, const Eigen::VectorXd& upper,
                             bool match_mean, std::vector<ConstraintFamily>* families) {
  const auto& w = weights.of_stiffness;
  Conditions conditions(P.size());
  const auto twofold = conditions.addFamily("stretch_2", w[0]),
             fourfold = conditions.addFamily("stretch_4", w[1]),
             stretch = conditions.addFamily("stretch", w[2]);
  for (std::size_t m = 0; m < arms.size(); ++m) {
    const double T =
        6.0 * sheet.young_modulus * sheet.thickness * areas[static_cast<Eigen::Index>(m)];
    double s4 = 0.0, c4 = 0.0;  // sum P U {sin 4b, cos 4b}
    for (const Arm& a : arms[m]) {
      s4 += P[a.spring] * a.U * a.s4;
      c4 += P[a.spring] * a.U * a.c4;
    }
    const auto add = [&](std::size_t family, double right, auto&& factor) {
      addCondition(arms[m], family, T, right, factor, &conditions);
    };
    add(twofold, 0.0, [](const Arm& a) { return a.U * a.U * a.s2; });
    add(twofold, 0.0, [](const Arm& a) { return a.U * a.U * a.c2; });
    add(fourfold, s4, [](const Arm& a) { return a.U * a.U * a.s4; });
    add(fourfold, c4, [](const Arm& a) { return a.U * a.U * a.c4; });
    add(stretch, T, [](const Arm& a) { return a.U * a.U; });
  }
  Eigen::VectorXd k = boundedLeastSquares(conditions.matrix(), conditions.right(), upper).x;
  if (match_mean) k = (conditions.matchingFactor(stretch, k) * k).cwiseMin(upper);
  *families = conditions.residuals(k);
  return k;
}

}  // namespace

SheetFit fitSheet(const Sheet& sheet, const mesh::SurfaceMesh& surface, double areal_density,
                  const SheetWeights& weights, const FitSettings& settings) {
  check(sheet);
  requirePositive("areal_density", areal_density);
  SheetTopology topology = sheetTopology(surface.points, surface.triangles);
  SheetFit fit;
  fit.counts = topology.counts;
  SpringNetwork& network = fit.network;
  network.points = surface.points;
  network.springs = std::move(topology.springs);
  const Eigen::VectorXd areas = triangleShares(surface.points, surface.triangles);
  network.masses = areal_density * areas;
  const auto count = static_cast<Eigen::Index>(network.springs.size());
  Eigen::VectorXd upper = Eigen::VectorXd::Constant(count, std::numeric_limits<double>::infinity());
  if (settings.explicit_step != 0.0) {
    upper = largestStiffness(network.springs, network.masses, settings.explicit_step);
  }
  const std::vector<std::vector<Arm>> arms = armsOf(network, surface);
  const Eigen::VectorXd P = fitPreload(sheet, arms, areas, meanSquareEdge(network.springs), weights,
                                       count, settings.match_mean, &fit.preload);
  const Eigen::VectorXd k =
      fitStiffness(sheet, arms, areas, P, weights, upper, settings.match_mean, &fit.stiffness);
  for (Eigen::Index i = 0; i < count; ++i) {
    network.springs[static_cast<std::size_t>(i)].preload = P[i];
    network.springs[static_cast<std::size_t>(i)].stiffness = k[i];
  }
  return fit;
}

}  // namespace palpate::springs
