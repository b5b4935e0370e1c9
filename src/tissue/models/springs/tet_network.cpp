// SPDX-License-Identifier: GPL-3.0-or-later
#include "tet_network.h"

#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "palpate/springs/fitted_solid.h"
#include "palpate/springs/springs_file.h"

namespace palpate::tissue {
namespace {

constexpr int kTetEdges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
// Of the mesh's size: so far may points of a file be from the mesh's.
constexpr double kSamePoint = 1e-3;

double youngModulus(const material::Solid& solid) {
  const material::Moduli m = material::moduli(solid.law);
  return 9.0 * m.kappa * m.mu / (3.0 * m.kappa + m.mu);
}

struct Around {                     // an edge
  double volume = 0.0, work = 0.0;  // V, E V
};
using Edges = std::map<std::pair<int, int>, Around>;

Edges edgesOf(const mesh::TetMesh& mesh, const fem::Composition& composition) {
  Edges edges;
  for (int t = 0; t < static_cast<int>(mesh.numTets()); ++t) {
    const double volume = mesh::signedVolume(mesh.points, mesh.tets.col(t));
    for (const auto& e : kTetEdges) {
      Around& around = edges[std::minmax(mesh.tets(e[0], t), mesh.tets(e[1], t))];
      around.volume += volume;
      around.work += youngModulus(composition.solid(t)) * volume;
    }
  }
  return edges;
}

springs::SpringNetwork byVolumes(const mesh::TetMesh& mesh, const Edges& edges) {
  springs::SpringNetwork network{mesh.points, {}, {}};
  for (const auto& [ends, around] : edges) {
    const double length = (mesh.points.col(ends.first) - mesh.points.col(ends.second)).norm();
    network.springs.push_back({ends.first, ends.second, around.work / (length * length), 0.0, 0.0,
                               length, springs::SpringKind::kEdge});
  }
  return network;
}

std::string describe(const springs::SolidFit& fit) {
  std::ostringstream text;
  text.precision(2);
  text << fit.network.springs.size() << " springs fitted";
  for (const springs::ConstraintFamily& family : fit.stiffness) {
    text << ", " << family.name << " within " << 100.0 * family.rms << " %";
  }
  text << " (rms); " << fit.slack << " of them slack";
  return text.str();
}

springs::SpringNetwork byLeastSquares(const mesh::TetMesh& mesh, const Edges& edges,
                                      std::vector<std::string>* notes) {
  springs::FitSettings right_mean;
  right_mean.match_mean = true;
  springs::SolidFit fit = springs::fitSolid(mesh, 1.0, 1.0, right_mean);
  for (springs::Spring& spring : fit.network.springs) {
    const Around& around = edges.at(std::minmax(spring.a, spring.b));
    spring.stiffness *= around.work / around.volume;
  }
  notes->push_back(describe(fit));
  return fit.network;
}

springs::SpringNetwork fromFile(const std::string& file, const mesh::TetMesh& mesh,
                                const Pose& X_WO) {
  springs::SpringNetwork network = springs::readSprings(file);
  network.points = (X_WO * network.points.colwise().homogeneous()).eval();
  const double size = (mesh.points.rowwise().maxCoeff() - mesh.points.rowwise().minCoeff()).norm();
  if (network.points.cols() != mesh.numPoints() ||
      (network.points - mesh.points).colwise().norm().maxCoeff() > kSamePoint * size) {
    throw std::invalid_argument("springs.file = " + file +
                                ": its points must be those of the organ's tetrahedra, " +
                                std::to_string(mesh.numPoints()));
  }
  return network;
}

}  // namespace

springs::SpringNetwork tetNetwork(const mesh::TetMesh& mesh, const Pose& X_WO,
                                  const fem::Composition& composition,
                                  const SpringSettings& settings, std::vector<std::string>* notes) {
  springs::SpringNetwork network;
  if (settings.constants == "file") {
    network = fromFile(settings.file, mesh, X_WO);
  } else {
    const Edges edges = edgesOf(mesh, composition);
    network = settings.constants == "volumes" ? byVolumes(mesh, edges)
                                              : byLeastSquares(mesh, edges, notes);
  }
  network.masses.setZero(mesh.numPoints());
  for (int t = 0; t < static_cast<int>(mesh.numTets()); ++t) {
    const double quarter =
        0.25 * composition.solid(t).density * mesh::signedVolume(mesh.points, mesh.tets.col(t));
    for (int a = 0; a < 4; ++a) network.masses[mesh.tets(a, t)] += quarter;
  }
  return network;
}

}  // namespace palpate::tissue
