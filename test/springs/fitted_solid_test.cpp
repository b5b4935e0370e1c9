// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/fitted_solid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <stdexcept>

#include "palpate/mesh/volume_mesher.h"
#include "palpate/springs/network_statics.h"
#include "palpate/springs/spring_grids.h"
#include "palpate/springs/step_bound.h"
#include "springs/fourth_order.h"
#include "support/contains.h"
#include "support/random.h"

namespace palpate::springs::fitted_solid_test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double E = 100.0;  // N/cm^2, cm: the bodies of [Wang 2005, 7.4]

/// A prism of many sides along z.
mesh::SurfaceMesh shaftSurface(double radius, double length, int sides) {
  mesh::SurfaceMesh surface;
  surface.points = Points::Zero(3, 2 * sides + 2);
  surface.triangles.resize(3, 4 * sides);
  surface.points.col(2 * sides + 1).z() = length;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * kPi * i / sides;
    const int next = (i + 1) % sides;
    surface.points.col(i) << radius * std::cos(angle), radius * std::sin(angle), 0.0;
    surface.points.col(sides + i) = surface.points.col(i) + Vec3(0, 0, length);
    surface.triangles.col(4 * i) << 2 * sides, next, i;
    surface.triangles.col(4 * i + 1) << 2 * sides + 1, sides + i, sides + next;
    surface.triangles.col(4 * i + 2) << i, next, sides + next;
    surface.triangles.col(4 * i + 3) << i, sides + next, sides + i;
  }
  return surface;
}

mesh::SurfaceMesh boxSurface(double size) {
  mesh::SurfaceMesh surface;
  const mesh::TetMesh box = mesh::boxMesh(Vec3::Constant(size), Eigen::Vector3i::Ones());
  surface.points = box.points;
  surface.triangles = mesh::boundaryTriangles(box.tets);
  return surface;
}

mesh::TetMesh fill(const mesh::SurfaceMesh& surface, double edge_length) {
  mesh::MeshingOptions options;
  options.edge_length.coarsest = edge_length;
  return mesh::meshVolume(surface, options);
}

double volumeOf(const mesh::TetMesh& mesh) {
  double volume = 0.0;
  for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
    volume += mesh::signedVolume(mesh.points, mesh.tets.col(t));
  }
  return volume;
}

/// Of all conditions at a point, over the length of their right side.
double rms(const SolidFit& fit) {
  double sum = 0.0;
  for (const ConstraintFamily& family : fit.stiffness) sum += family.rms * family.rms;
  return std::sqrt(sum);
}

// What a relative error r of sum k U^2 e e e e does to the energy of a uniform strain is at most
// r |T| |eps eps| / eps T eps, with T = d d + d d + d d, whose length is the root of 45.
double energyBound(double r, const Mat3& strain) {
  const double trace = strain.trace(), square = strain.squaredNorm();
  return r * std::sqrt(45.0) * square / (trace * trace + 2 * square);
}

// The network's energy where the points are displaced by u(X), linear: no less than that it has
// in equilibrium between the same ends.
template <class F>
double energyOf(const SpringNetwork& network, const F& u) {
  double energy = 0.0;
  for (const Spring& s : network.springs) {
    const Vec3 d = network.points.col(s.b) - network.points.col(s.a);
    const Vec3 change = u(network.points.col(s.b)) - u(network.points.col(s.a));
    energy += 0.5 * change.dot(springTangent(s, d) * change);
  }
  return energy;
}

struct Response {
  double force = 0.0;    // along z at the far end
  double moment = 0.0;   // about z at the far end
  double x_ratio = 0.0;  // contraction over extension, least squares over the points
  double y_ratio = 0.0;
};

// Both ends prescribed along z; `hold_sides` there in x and y as well.
Response respond(const SpringNetwork& network, double length, double extension, double twist,
                 bool hold_sides) {
  const Points& X = network.points;
  NetworkLoads loads = noLoads(network);
  Points prescribed = Points::Zero(3, X.cols());
  const auto far = [&](Eigen::Index i) { return X(2, i) > length * (1.0 - 1e-9); };
  const Vec3 middle = 0.5 * (X.rowwise().maxCoeff() + X.rowwise().minCoeff());
  Eigen::Index centre = -1;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    const bool near = X(2, i) < length * 1e-9;
    if (near || far(i)) loads.free(2, i) = 0.0;
    if (hold_sides && (near || far(i))) loads.free.col(i).setZero();
    if (far(i)) prescribed.col(i) << -twist * X(1, i), twist * X(0, i), extension;
    if (near && (centre < 0 || (X.col(i) - middle).head<2>().norm() <
                                   (X.col(centre) - middle).head<2>().norm())) {
      centre = i;
    }
  }
  if (!hold_sides) {  // rigid motions in the plane: a point, and the angle of the farthest one
    Eigen::Index arm = centre;
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
      const bool near = X(2, i) < length * 1e-9;
      if (near && X(0, i) - X(0, centre) > X(0, arm) - X(0, centre)) arm = i;
    }
    loads.free.col(centre).setZero();
    loads.free(1, arm) = 0.0;
  }
  const auto moved = linearDisplacements(network, X, loads, prescribed);
  if (!moved) throw std::runtime_error("a mechanism");
  const Eigen::VectorXd f =
      networkTangent(network, X) * Eigen::Map<const Eigen::VectorXd>(moved->data(), moved->size());
  Response response;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    if (!far(i)) continue;
    response.force += f[3 * i + 2];
    response.moment += X(0, i) * f[3 * i + 1] - X(1, i) * f[3 * i];
  }
  const auto ratio = [&](int axis) {
    const Eigen::ArrayXd x = X.row(axis).array() - X.row(axis).mean();
    const Eigen::ArrayXd u = moved->row(axis).array() - moved->row(axis).mean();
    return -(x * u).sum() / (x * x).sum() / (extension / length);
  };
  if (extension != 0.0) {
    response.x_ratio = ratio(0);
    response.y_ratio = ratio(1);
  }
  return response;
}

void print(const char* name, const SolidFit& fit) {
  std::cout << name << ": " << fit.network.points.cols() << " points, "
            << fit.network.springs.size() << " springs, " << fit.slack << " slack;";
  for (const ConstraintFamily& f : fit.stiffness) {
    std::cout << " " << f.name << " rms " << f.rms << " worst " << f.worst;
  }
  std::cout << "\n";
}

TEST(FourthOrder, PartsAddUpAndAreOrthogonal) {
  test::Random random;
  EXPECT_NEAR(isotropicFourth().norm(), std::sqrt(45.0), 1e-14);
  FourthOrder t = FourthOrder::Zero();
  for (int i = 0; i < 10; ++i) t += random.uniform(-1, 1) * fourthPower(random.vector(1.0));
  const FourthOrderParts parts = partsOf(t);
  EXPECT_LT((parts.isotropic + parts.second + parts.rest - t).norm(), 1e-14);
  EXPECT_NEAR(parts.isotropic.dot(parts.second), 0.0, 1e-13);
  EXPECT_NEAR(parts.isotropic.dot(parts.rest), 0.0, 1e-13);
  EXPECT_NEAR(parts.second.dot(parts.rest), 0.0, 1e-13);
  const Vec3 v = random.vector(1.0), w = random.vector(1.0);
  EXPECT_NEAR(fourthPower(v).dot(fourthPower(w)), std::pow(v.dot(w), 4), 1e-14);
  EXPECT_NEAR(fourthPower(v).dot(isotropicFourth()), 3 * std::pow(v.squaredNorm(), 2), 1e-14);
}

// The springs of a lattice of cubes meet all conditions inside.
TEST(FittedSolid, TheLatticeOfCubesMeetsTheConditions) {
  const SpringNetwork cubes =
      cubeNetwork(cubeSprings(E, 1.0, CubeDiagonals::kFaces), 1.0, {2, 2, 2}, 1.0);
  FourthOrder sum = FourthOrder::Zero();
  for (const Spring& s : cubes.springs) {
    const Vec3 d = cubes.points.col(s.b) - cubes.points.col(s.a);
    if (s.a == 13 || s.b == 13) {
      sum += s.stiffness * d.squaredNorm() * fourthPower(d.normalized());
    }
  }
  EXPECT_LT((sum - 0.8 * E * isotropicFourth()).norm(), 1e-12 * E);
}

TEST(FittedSolid, BoundsAndMassesAreKept) {
  const mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.1, 0.1, 0.1), {3, 3, 3});
  const SolidFit free = fitSolid(mesh, 5e3, 1000.0);
  EXPECT_NO_THROW(checkNetwork(free.network));
  EXPECT_NEAR(free.network.masses.sum(), 1.0, 1e-12);
  EXPECT_EQ(free.bounded, 0);
  const double step = 1e-2;
  const SolidFit bounded = fitSolid(mesh, 5e3, 1000.0, {step});
  const Eigen::VectorXd M = largestStiffness(bounded.network.springs, bounded.network.masses, step);
  for (std::size_t i = 0; i < bounded.network.springs.size(); ++i) {
    EXPECT_GE(bounded.network.springs[i].stiffness, 0.0);
    EXPECT_LE(bounded.network.springs[i].stiffness, M[static_cast<Eigen::Index>(i)]);
  }
  EXPECT_GT(bounded.bounded, 0);
  EXPECT_GT(rms(bounded), rms(free));
}

TEST(FittedSolid, DoesNotDependOnTheFrame) {
  test::Random random;
  const mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.1, 0.2, 0.1), {2, 3, 2});
  mesh::TetMesh turned = mesh;
  turned.points = (random.rotation() * mesh.points).colwise() + random.vector(1.0);
  const SolidFit one = fitSolid(mesh, 5e3, 1000.0), other = fitSolid(turned, 5e3, 1000.0);
  double largest = 0.0;
  for (const Spring& s : one.network.springs) largest = std::max(largest, s.stiffness);
  for (std::size_t i = 0; i < one.network.springs.size(); ++i) {
    EXPECT_NEAR(one.network.springs[i].stiffness, other.network.springs[i].stiffness,
                1e-6 * largest);
  }
  for (std::size_t f = 0; f < one.stiffness.size(); ++f) {
    EXPECT_NEAR(one.stiffness[f].rms, other.stiffness[f].rms, 1e-7);
  }
}

// With and without the mean of the stiffnesses matched.
class FittedBody : public ::testing::TestWithParam<bool> {};

// Cube of 10 cm, 1000 N a cm (7.74).
TEST_P(FittedBody, CubeInTension) {
  const SolidFit fit = fitSolid(fill(boxSurface(10.0), 1.8), E, 1.0, {0.0, GetParam()});
  print("cube", fit);
  const double bound = energyBound(rms(fit), Vec3(-0.25, -0.25, 1.0).asDiagonal());
  const Response r = respond(fit.network, 10.0, 0.01, 0.0, false);
  const double expected = E * 100.0 / 10.0 * 0.01;
  std::cout << "force " << r.force / expected << " of 1000 N/cm, contraction " << r.x_ratio << " "
            << r.y_ratio << "; bound " << bound << "\n";
  EXPECT_NEAR(r.force / expected, 1.0, bound);
  const double uniform = energyOf(fit.network, [](const Vec3& X) {
    return Vec3(0.001 * Vec3(-0.25, -0.25, 1.0).cwiseProduct(X));
  });
  EXPECT_LE(0.5 * r.force * 0.01, uniform * (1.0 + 1e-9));
  for (const double ratio : {r.x_ratio, r.y_ratio}) EXPECT_NEAR(ratio, 0.25, 0.25 * bound);
}

// Shaft of radius 5 cm, 15 cm long: 523.6 N a cm (7.75), and G alpha pi R^4/2 of torsion; of the
// area that its mesh has.
TEST_P(FittedBody, ShaftInTensionAndTorsion) {
  const double L = 15.0;
  const mesh::TetMesh mesh = fill(shaftSurface(5.0, L, 40), 1.8);
  const SolidFit fit = fitSolid(mesh, E, 1.0, {0.0, GetParam()});
  print("shaft", fit);
  const double area = volumeOf(mesh) / L;
  EXPECT_NEAR(area, 25 * kPi, 0.02 * 25 * kPi);
  const double pull_bound = energyBound(rms(fit), Vec3(-0.25, -0.25, 1.0).asDiagonal());
  const Response pulled = respond(fit.network, L, 0.01, 0.0, false);
  const double force = E * area / L * 0.01;
  std::cout << "force " << pulled.force / force << ", contraction " << pulled.x_ratio << " "
            << pulled.y_ratio << "; bound " << pull_bound << "\n";
  EXPECT_NEAR(pulled.force / force, 1.0, pull_bound);
  for (const double ratio : {pulled.x_ratio, pulled.y_ratio}) {
    EXPECT_NEAR(ratio, 0.25, 0.25 * pull_bound);
  }
  Mat3 shear = Mat3::Zero();
  shear(0, 1) = shear(1, 0) = 0.5;
  const double twist_bound = energyBound(rms(fit), shear), alpha = 1e-3;
  const Response twisted = respond(fit.network, L, 0.0, alpha * L, true);
  const double moment = E / 2.5 * alpha * area * area / (2 * kPi);
  std::cout << "moment " << twisted.moment / moment << "; bound " << twist_bound << "\n";
  EXPECT_NEAR(twisted.moment / moment, 1.0, twist_bound);
  const double uniform = energyOf(
      fit.network, [&](const Vec3& X) { return Vec3(alpha * X.z() * Vec3(-X.y(), X.x(), 0.0)); });
  EXPECT_LE(0.5 * twisted.moment * alpha * L, uniform * (1.0 + 1e-9));
}

INSTANTIATE_TEST_SUITE_P(MatchMean, FittedBody, ::testing::Bool());

TEST(FittedSolid, MatchedMeanIsThatOfTheSolid) {
  const mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.1, 0.1, 0.1), {3, 3, 3});
  const SolidFit fit = fitSolid(mesh, 5e3, 1000.0, {0.0, true});
  double sum = 0.0;
  for (const Spring& s : fit.network.springs) sum += 2 * s.stiffness * s.length * s.length;
  EXPECT_NEAR(sum, 12 * 5e3 * 1e-3, 1e-9 * sum);  // 12 E V (7.59)
}

TEST(FittedSolid, RefusesWhatIsNoBody) {
  mesh::TetMesh mesh = mesh::boxMesh(Vec3(1, 1, 1), {1, 1, 1});
  EXPECT_THROW(fitSolid(mesh::TetMesh(), E, 1.0), std::invalid_argument);
  EXPECT_THROW(fitSolid(mesh, -E, 1.0), std::invalid_argument);
  EXPECT_THROW(fitSolid(mesh, E, 0.0), std::invalid_argument);
  mesh.points.conservativeResize(3, 9);
  mesh.points.col(8).setConstant(4.0);
  EXPECT_THROW(fitSolid(mesh, E, 1.0), std::invalid_argument);
  mesh.points.col(mesh.tets(0, 2)) = mesh.points.col(mesh.tets(1, 2));
  try {
    fitSolid(mesh, E, 1.0);
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_TRUE(test::contains(e.what(), "is collapsed"));
  }
}

}  // namespace
}  // namespace palpate::springs::fitted_solid_test
