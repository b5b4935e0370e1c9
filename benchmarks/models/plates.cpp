// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>
#include <vector>

#include "palpate/io/json.h"
#include "palpate/mesh/planar_mesh.h"
#include "palpate/springs/fitted_sheet.h"
#include "parts.h"
#include "rest.h"

namespace palpate::models {
namespace {

using namespace springs;

// N/cm^2, cm: the plates of [Wang 2005, 6.4.1], 32 x 24 cm, their load in N and N/cm^2.
const Sheet kSheet{1.0e7, 0.3, 0.1};
constexpr double kForce = 1.0, kPressure = 0.002, kClamp = 4.0;

// It may go on behind the clamped line x = 0.
mesh::SurfaceMesh triangles(bool hole, double edge, double behind) {
  mesh::Polygon outline(2, behind > 0 ? 6 : 4);
  if (behind > 0) {
    outline << -behind, 0, 32, 32, 0, -behind, 0, 0, 0, 24, 24, 24;
  } else {
    outline << 0, 32, 32, 0, 0, 0, 24, 24;
  }
  std::vector<mesh::Polygon> holes;
  if (hole) holes.push_back(mesh::circle({16, 12}, 6.0, edge));
  return mesh::meshPolygon(outline, holes, edge);
}

std::string trianglesJson(const mesh::SurfaceMesh& surface) {
  io::JsonMembers out;
  const Eigen::VectorXd corners =
      Eigen::Map<const Eigen::VectorXi>(surface.triangles.data(), surface.triangles.size())
          .cast<double>();
  out.add("x", io::json(Eigen::VectorXd(surface.points.row(0).transpose())));
  out.add("y", io::json(Eigen::VectorXd(surface.points.row(1).transpose())));
  out.add("corners", io::json(corners));
  return out.object();
}

struct Loads {
  NetworkLoads corner, pressure;
};

Loads loadsOn(const SpringNetwork& network) {
  Loads loads{noLoads(network), noLoads(network)};
  const Points& X = network.points;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    if ((X.col(i) - Vec3(32, 24, 0)).norm() < 1e-6) loads.corner.forces(2, i) = kForce;
    if (X(0, i) <= 1e-6) {
      loads.corner.free.col(i).setZero();
      loads.pressure.free.col(i).setZero();
    }
  }
  loads.pressure.forces.row(2) = kPressure * network.masses.transpose();  // of an areal density 1
  return loads;
}

// Largest deflections without and with large displacements, and the latter without preload.
std::string deflections(const SpringNetwork& network, const NetworkLoads& loads) {
  io::JsonMembers out;
  const auto moved = moveLinearly(network, loads);
  if (moved) out.add("linear", moved->row(2).maxCoeff());
  Points x = network.points;
  comeToRest(network, loads, 1e-7, &x, 1000);
  out.add("large", x.row(2).maxCoeff());
  SpringNetwork bare = network;
  for (Spring& s : bare.springs) s.preload = 0.0;
  out.add("bare_resists_small_ones", moveLinearly(bare, loads) ? 1.0 : 0.0);
  Points y = network.points;
  const auto report = solveNetwork(bare, loads, {1e-6, 5000}, &y);
  out.add("bare", y.row(2).maxCoeff());
  out.add("bare_imbalance", report.imbalance);
  return out.object();
}

// Largest deflections of fitted springs for small ones, mesh by mesh; NaN where none resist.
std::string linearByEdge(bool hole, const Eigen::VectorXd& edges) {
  Eigen::VectorXd points(edges.size()), corner(edges.size()), pressure(edges.size());
  for (Eigen::Index k = 0; k < edges.size(); ++k) {
    const SpringNetwork network = fitSheet(kSheet, triangles(hole, edges[k], kClamp), 1.0).network;
    const Loads loads = loadsOn(network);
    const auto largest = [&](const NetworkLoads& on) {
      const auto moved = moveLinearly(network, on);
      return moved ? moved->row(2).maxCoeff() : std::nan("");
    };
    points[k] = double(network.points.cols());
    corner[k] = largest(loads.corner);
    pressure[k] = largest(loads.pressure);
  }
  io::JsonMembers out;
  out.add("points", io::json(points));
  out.add("corner", io::json(corner));
  out.add("pressure", io::json(pressure));
  return out.object();
}

}  // namespace

std::string plates(bool quick) {
  const double edge = quick ? 5.0 : 2.0;
  const Eigen::VectorXd edges = quick ? Eigen::VectorXd(Eigen::Vector2d(6.0, 5.0))
                                      : Eigen::VectorXd(Eigen::Vector4d(4.0, 3.0, 2.0, 1.5));
  io::JsonMembers out;
  out.add("edges", io::json(edges));
  for (const bool hole : {false, true}) {
    io::JsonMembers plate;
    for (const bool matched : {false, true}) {
      const SheetFit fit = fitSheet(kSheet, triangles(hole, edge, kClamp), 1.0, {}, {0.0, matched});
      const Loads loads = loadsOn(fit.network);
      io::JsonMembers fitted;
      fitted.add("points", double(fit.network.points.cols()));
      fitted.add("springs", double(fit.network.springs.size()));
      fitted.add("corner", deflections(fit.network, loads.corner));
      fitted.add("pressure", deflections(fit.network, loads.pressure));
      plate.add(matched ? "matched" : "fitted", fitted.object());
    }
    plate.add("by_edge", linearByEdge(hole, edges));
    plate.add("coarse", trianglesJson(triangles(hole, quick ? 6.0 : 1.0, 0.0)));
    plate.add("fine", trianglesJson(triangles(hole, quick ? 4.0 : 0.5, 0.0)));
    out.add(hole ? "hole" : "whole", plate.object());
  }
  return out.object();
}

}  // namespace palpate::models
