// SPDX-License-Identifier: GPL-3.0-or-later
#include "enriched_bodies.h"

#include <cmath>
#include <utility>

#include "palpate/material/material.h"
#include "palpate/mesh/cell_mesh.h"
#include "palpate/mesh/surface_levels.h"
#include "palpate/mesh/volume_mesher.h"
#include "palpate/organs/organs.h"

namespace palpate::models {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kFineEdge = 1.5;  // of fine tetrahedra, in edges of the fine surface

// Of `around` points a ring: `caps` rings on each end within the rim, `rings` along the side, a
// point in the middle of each end.
mesh::SurfaceMesh roundBar(double radius, double length, int around, int rings, int caps) {
  std::vector<std::pair<double, double>> profile;  // radius, height of each ring
  for (int k = 1; k <= caps; ++k) profile.emplace_back(radius * k / (caps + 1.0), 0.0);
  for (int k = 0; k < rings; ++k) profile.emplace_back(radius, length * k / (rings - 1.0));
  for (int k = caps; k >= 1; --k) profile.emplace_back(radius * k / (caps + 1.0), length);
  const int n = static_cast<int>(profile.size()), bottom = n * around, top = bottom + 1;
  mesh::SurfaceMesh surface;
  surface.points = Points::Zero(3, top + 1);
  surface.points(2, top) = length;
  surface.triangles.resize(3, 2 * n * around);
  int t = 0;
  for (int k = 0; k < n; ++k) {
    for (int i = 0; i < around; ++i) {
      const auto [r, z] = profile[static_cast<std::size_t>(k)];
      const double angle = 2.0 * kPi * i / around;
      surface.points.col(k * around + i) << r * std::cos(angle), r * std::sin(angle), z;
      const int a = k * around + i, b = k * around + (i + 1) % around;
      if (k == 0) surface.triangles.col(t++) << bottom, b, a;
      if (k == n - 1) {
        surface.triangles.col(t++) << top, a, b;
      } else {
        surface.triangles.col(t++) << a, b, b + around;
        surface.triangles.col(t++) << a, b + around, a + around;
      }
    }
  }
  return surface;
}

// Points of the side and the rim onto the circle; those of the ends are in their plane already.
void roundSides(double radius, double length, Points* points) {
  for (Eigen::Index i = 0; i < points->cols(); ++i) {
    const double r = points->col(i).head<2>().norm(), z = (*points)(2, i);
    const bool side = z > 1e-9 && z < length - 1e-9;
    const bool rim = r > 0.97 * radius;  // the middle of a chord of 24 degrees is at 0.978
    if (side || rim) points->col(i).head<2>() *= radius / r;
  }
}

void finish(EnrichedBody* body) {
  body->fine_edge = kFineEdge * mesh::meanEdgeLength({body->fine.points, body->fine.triangles, {}});
  body->coarse_edge = body->patch =
      mesh::meanEdgeLength({body->coarse.points, body->coarse.triangles, {}});
  for (int i = 0; i < body->coarse.points.cols(); ++i) {
    const double z = body->coarse.points(2, i);
    if (z > body->held_below + body->patch && z < body->held_above - body->patch) {
      body->contacts.push_back(i);
    }
  }
}

}  // namespace

EnrichedBody cylinderBody() {
  const double radius = 0.02, length = 0.08;
  EnrichedBody body;
  body.name = "cylinder";
  body.coarse = roundBar(radius, length, 15, 8, 2);
  body.fine = mesh::splitTriangles(body.coarse);
  roundSides(radius, length, &body.fine.points);
  body.true_surface = mesh::splitTriangles(body.fine);
  roundSides(radius, length, &body.true_surface.points);
  body.held_below = 1e-6;
  body.held_above = length - 1e-6;
  body.plan.force = 0.3;
  body.train = 18;
  body.test = 10;
  finish(&body);
  return body;
}

EnrichedBody liverBody() {
  EnrichedBody body;
  body.name = "liver";
  body.true_surface = organs::makeOrgan("liver", 0.006);
  body.coarse = mesh::simplify(body.true_surface, 276);
  mesh::moveOnto(body.true_surface, 0, &body.coarse.points);
  body.fine = body.coarse;
  for (int k = 0; k < 2; ++k) {
    const Eigen::Index before = body.fine.points.cols();
    body.fine = mesh::splitTriangles(body.fine);
    mesh::moveOnto(body.true_surface, before, &body.fine.points);
  }
  body.held_below = 0.015;
  body.held_above = 1.0;
  body.plan.force = 1.0;
  body.train = 60;
  body.test = 45;
  finish(&body);
  return body;
}

mesh::TetMesh filled(const mesh::SurfaceMesh& surface, const mesh::SizeField& edge_length) {
  mesh::MeshingOptions options;
  options.edge_length = edge_length;
  return mesh::meshVolume(surface, options);
}

std::unique_ptr<enrichment::PressedBody> pressedBody(const EnrichedBody& body, mesh::TetMesh mesh,
                                                     const Points& surface) {
  const auto law =
      material::makeMaterial("corotational", {{"young_modulus", {5e3}}, {"poisson_ratio", {0.45}}});
  fem::FreeMask free = fem::FreeMask::Ones(3, mesh.numPoints());
  for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
    const double z = mesh.points(2, i);
    if (z <= body.held_below || z >= body.held_above) free.col(i).setZero();
  }
  return std::make_unique<enrichment::PressedBody>("anp", std::move(mesh),
                                                   fem::Composition::uniform(law, 1000.0), free,
                                                   surface, body.patch, nullptr);
}

}  // namespace palpate::models
