// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>
#include <vector>

#include "palpate/io/json.h"
#include "palpate/mesh/volume_mesher.h"
#include "palpate/springs/fitted_solid.h"
#include "palpate/springs/network_modes.h"
#include "palpate/springs/spring_grids.h"
#include "parts.h"
#include "rest.h"

namespace palpate::models {
namespace {

using namespace springs;

constexpr double E = 100.0, kSize = 10.0, kRadius = 5.0, kLength = 15.0;  // N/cm^2, cm
constexpr double kPi = 3.14159265358979323846, kExtension = 0.01, kTwist = 1e-3;
constexpr int kSides = 40;

/// A prism of many sides along z.
mesh::SurfaceMesh shaftSurface(int sides) {
  mesh::SurfaceMesh surface;
  surface.points = Points::Zero(3, 2 * sides + 2);
  surface.triangles.resize(3, 4 * sides);
  surface.points.col(2 * sides + 1).z() = kLength;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * kPi * i / sides;
    const int next = (i + 1) % sides;
    surface.points.col(i) << kRadius * std::cos(angle), kRadius * std::sin(angle), 0.0;
    surface.points.col(sides + i) = surface.points.col(i) + Vec3(0, 0, kLength);
    surface.triangles.col(4 * i) << 2 * sides, next, i;
    surface.triangles.col(4 * i + 1) << 2 * sides + 1, sides + i, sides + next;
    surface.triangles.col(4 * i + 2) << i, next, sides + next;
    surface.triangles.col(4 * i + 3) << i, sides + next, sides + i;
  }
  return surface;
}

mesh::SurfaceMesh cubeSurface() {
  const mesh::TetMesh box = mesh::boxMesh(Vec3::Constant(kSize), Eigen::Vector3i::Ones());
  mesh::SurfaceMesh surface;
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

/// At the ends across an axis, of which the far one is displaced along it or turned about it.
struct Ends {
  const SpringNetwork& network;
  int axis;
  double length;

  bool near(Eigen::Index i) const { return network.points(axis, i) < length * 1e-9; }
  bool far(Eigen::Index i) const { return network.points(axis, i) > length * (1.0 - 1e-9); }

  /// Force along the axis and moment about the z axis at the far end; displacements.
  struct Answer {
    double force = 0.0, moment = 0.0;
    Points moved;
  };
  Answer answer(const NetworkLoads& loads, const Points& prescribed) const {
    const Points& X = network.points;
    const auto moved = linearDisplacements(network, X, loads, prescribed);
    if (!moved) throw std::runtime_error("a body that does not resist");
    const Eigen::VectorXd f = networkTangent(network, X) *
                              Eigen::Map<const Eigen::VectorXd>(moved->data(), moved->size());
    Answer answer{0.0, 0.0, *moved};
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
      if (!far(i)) continue;
      answer.force += f[3 * i + axis];
      answer.moment += X(0, i) * f[3 * i + 1] - X(1, i) * f[3 * i];
    }
    return answer;
  }
};

// The ends glide; the near one's middle stays, and a point of it on a line through that.
std::string pull(const SpringNetwork& network, int axis, double length, double area,
                 double extension) {
  const Ends ends{network, axis, length};
  const Points& X = network.points;
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  NetworkLoads loads = noLoads(network);
  Points prescribed = Points::Zero(3, X.cols());
  const Vec3 middle = 0.5 * (X.rowwise().maxCoeff() + X.rowwise().minCoeff());
  const auto off = [&](Eigen::Index i) {
    return std::hypot(X(u, i) - middle[u], X(v, i) - middle[v]);
  };
  Eigen::Index centre = -1;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    if (ends.near(i) || ends.far(i)) loads.free(axis, i) = 0.0;
    if (ends.far(i)) prescribed(axis, i) = extension;
    if (ends.near(i) && (centre < 0 || off(i) < off(centre))) centre = i;
  }
  Eigen::Index arm = centre;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    if (ends.near(i) && X(u, i) > X(u, arm)) arm = i;
  }
  loads.free.col(centre).setZero();
  loads.free(v, arm) = 0.0;
  const Ends::Answer answer = ends.answer(loads, prescribed);
  const auto contraction = [&](int side) {
    const Eigen::ArrayXd x = X.row(side).array() - X.row(side).mean();
    const Eigen::ArrayXd w = answer.moved.row(side).array() - answer.moved.row(side).mean();
    return -(x * w).sum() / (x * x).sum() / (extension / length);
  };
  io::JsonMembers out;
  out.add("force", answer.force / extension);  // N/cm
  out.add("force_of_theory", E * area / length);
  out.add("contraction_1", contraction(u));
  out.add("contraction_2", contraction(v));
  return out.object();
}

// Both ends are held in all directions.
std::string turn(const SpringNetwork& network, double area) {
  const Ends ends{network, 2, kLength};
  const Points& X = network.points;
  NetworkLoads loads = noLoads(network);
  Points prescribed = Points::Zero(3, X.cols());
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    if (ends.near(i) || ends.far(i)) loads.free.col(i).setZero();
    if (ends.far(i)) prescribed.col(i) << -X(1, i), X(0, i), 0.0;
  }
  io::JsonMembers out;
  out.add("moment", ends.answer(loads, kTwist * kLength * prescribed).moment / kTwist);  // N cm^2
  out.add("moment_of_theory", E / 2.5 * area * area / (2 * kPi));
  return out.object();
}

std::string lattice(int cells, CubeDiagonals diagonals, Constants constants) {
  const double edge = kSize / cells;
  const SpringNetwork network = cubeNetwork(cubeSprings(E, edge, diagonals, constants), edge,
                                            Eigen::Vector3i::Constant(cells), 1.0);
  io::JsonMembers out;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      const std::string name = std::string(sign > 0 ? "+" : "-") + "xyz"[axis];
      out.add(name, pull(network, axis, kSize, kSize * kSize, sign * kExtension));
    }
  }
  return out.object();
}

std::string fitted(const SolidFit& fit, double length, double area, bool shaft) {
  io::JsonMembers out;
  out.add("points", double(fit.network.points.cols()));
  out.add("springs", double(fit.network.springs.size()));
  out.add("slack", double(fit.slack));
  for (const ConstraintFamily& f : fit.stiffness) out.add("rms_" + f.name, f.rms);
  out.add("tension", pull(fit.network, 2, length, area, kExtension));
  if (shaft) out.add("torsion", turn(fit.network, area));
  return out.object();
}

std::string fittedBodies(double edge, bool matched) {
  const mesh::TetMesh cube = fill(cubeSurface(), edge), shaft = fill(shaftSurface(kSides), edge);
  const double section = volumeOf(shaft) / kLength;
  const FitSettings settings{0.0, matched};
  io::JsonMembers out;
  out.add("edge", edge);
  out.add("section", section);
  out.add("cube", fitted(fitSolid(cube, E, 1.0, settings), kSize, kSize * kSize, false));
  out.add("shaft", fitted(fitSolid(shaft, E, 1.0, settings), kLength, section, true));
  return out.object();
}

}  // namespace

std::string solids(bool quick) {
  const double edge = quick ? 4.0 : 1.8;
  io::JsonMembers out, modes;
  for (const int cells : {2, 5}) {
    out.add("cube_" + std::to_string(cells),
            lattice(cells, CubeDiagonals::kFaces, Constants::kCorrected));
  }
  out.add("cube_as_printed", lattice(5, CubeDiagonals::kFaces, Constants::kPrinted));
  out.add("fitted", fittedBodies(edge, false));
  out.add("matched", fittedBodies(edge, true));
  std::string by_edge;
  for (const double other :
       quick ? std::vector<double>{5.0, edge} : std::vector<double>{3.0, 2.4, edge, 1.3, 1.0}) {
    by_edge += (by_edge.empty() ? "" : ", ") + fittedBodies(other, false);
  }
  out.add("by_edge", "[" + by_edge + "]");
  Eigen::VectorXd body(quick ? 2 : 4), faces(body.size());
  for (int cells = 1; cells <= body.size(); ++cells) {
    const auto extra = [&](CubeDiagonals diagonals) {
      return networkModes(cubeNetwork(cubeSprings(E, 1.0, diagonals), 1.0,
                                      Eigen::Vector3i::Constant(cells), 1.0))
                 .neutral -
             6;
    };
    body[cells - 1] = extra(CubeDiagonals::kBody);
    faces[cells - 1] = extra(CubeDiagonals::kFaces);
  }
  modes.add("body_diagonals", io::json(body));
  modes.add("face_diagonals", io::json(faces));
  out.add("mechanisms", modes.object());
  return out.object();
}

}  // namespace palpate::models
