// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/enrichment/pressed_body.h"

#include <Eigen/Geometry>
#include <stdexcept>
#include <string>
#include <utility>

namespace palpate::enrichment {
namespace {

Eigen::VectorXd pointAreas(const mesh::SurfaceMesh& surface) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(surface.points.cols());
  for (const auto& t : surface.triangles.colwise()) {
    const Vec3 a = surface.points.col(t[0]), b = surface.points.col(t[1]);
    const double third = (b - a).cross(surface.points.col(t[2]) - a).norm() / 6.0;
    for (int k = 0; k < 3; ++k) areas[t[k]] += third;
  }
  return areas;
}

}  // namespace

PressedBody::PressedBody(const std::string& element, mesh::TetMesh mesh,
                         const fem::Composition& composition, const fem::FreeMask& free,
                         const Points& surface, double patch, ThreadPool* pool)
    : mesh_(std::move(mesh)),
      boundary_{mesh_.points, mesh::trianglesOf(mesh::boundaryFaces(mesh_))},
      areas_(pointAreas(boundary_)),
      places_(mesh::nearestSurfacePoints(boundary_, surface)),
      patch_(patch),
      elasticity_(fem::makeElasticity(element, mesh_, composition, pool)),
      load_(Points::Zero(3, mesh_.numPoints())) {
  const std::string motions = fem::freeRigidMotions(mesh_.points, free);
  if (!motions.empty()) throw std::invalid_argument("the body is not held: it leaves " + motions);
  potential_.elasticity = elasticity_.get();
  potential_.terms.push_back(&load_);
  potential_.free = free;
}

solver::StaticReport PressedBody::press(const Press& press, const solver::StaticSettings& settings,
                                        Points* displacements) {
  const Eigen::VectorXd parts =
      (mesh_.points.colwise() - press.contact).colwise().squaredNorm() / (patch_ * patch_);
  Eigen::VectorXd shares = areas_.array() * (1.0 - parts.array()).max(0.0);
  if (!(shares.sum() > 0.0)) {
    Eigen::Index nearest = 0;
    (areas_.array() > 0.0).select(parts, parts.maxCoeff() + 1.0).minCoeff(&nearest);
    shares[nearest] = 1.0;
  }
  load_.setForces(press.force * (shares / shares.sum()).transpose());
  Points x = mesh_.points;
  const auto setLoad = [&](double s) {
    load_.setFactor(s);
    return mesh_.points;
  };
  const solver::StaticReport report = solver::solveStatic(potential_, setLoad, settings, &x);
  mesh::interpolate(places_, x - mesh_.points, displacements);
  return report;
}

}  // namespace palpate::enrichment
