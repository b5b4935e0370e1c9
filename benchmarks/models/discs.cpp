// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <vector>

#include "palpate/io/json.h"
#include "palpate/springs/spring_grids.h"
#include "parts.h"
#include "rest.h"

namespace palpate::models {
namespace {

using namespace springs;

constexpr double kRadius = 10.0, kThickness = 0.01, kPi = 3.14159265358979323846;

struct Disc {
  SpringNetwork network;
  Points free;
  Eigen::Index middle = -1;
};

enum class Mesh { kTriangles, kBendingTriangles, kSquares };

// Nodes inside the radius may move, three rings beyond are held.
Disc clampedDisc(const Sheet& sheet, Mesh mesh, int n) {
  const double U = kRadius / n;
  Eigen::Matrix2d axes = Eigen::Matrix2d::Identity();
  if (mesh != Mesh::kSquares) axes << 1.0, 0.5, 0.0, 0.5 * std::sqrt(3.0);
  std::vector<GridNode> nodes;
  const int reach = 2 * (n + 4);
  for (int j = -reach; j <= reach; ++j) {
    for (int i = -reach; i <= reach; ++i) {
      if ((axes * Eigen::Vector2d(i, j)).norm() < n + 3.5) nodes.emplace_back(i, j);
    }
  }
  Disc disc;
  if (mesh == Mesh::kSquares) {
    disc.network = rectangleNetwork(rectangleSprings(sheet, U), U, nodes, 1.0);
  } else {
    disc.network = triangleNetwork(
        mesh == Mesh::kTriangles ? triangleSprings(sheet, U) : bendingTriangleSprings(sheet, U), U,
        nodes, 1.0);
  }
  disc.free = Points::Ones(3, disc.network.points.cols());
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    if ((axes * nodes[k].cast<double>()).norm() > n * (1.0 - 1e-9)) disc.free.col(i).setZero();
    if (nodes[k] == GridNode(0, 0)) disc.middle = i;
  }
  return disc;
}

double plate(const Sheet& sheet) {
  return 16 * kPi * sheet.bendingStiffness() / (kRadius * kRadius);
}

// Of small deflections, over that of the plate.
double linearRatio(const Sheet& sheet, Mesh mesh, int n) {
  const Disc disc = clampedDisc(sheet, mesh, n);
  NetworkLoads loads = noLoads(disc.network);
  loads.free = disc.free;
  loads.free.topRows<2>().setZero();
  loads.forces(2, disc.middle) = 1.0;
  const auto moved = moveLinearly(disc.network, loads);
  return moved ? 1.0 / (*moved)(2, disc.middle) / plate(sheet) : 0.0;
}

// Largest stiffness across the sheet of any mass without preload, over that with it.
double resistanceWithoutPreload(const Sheet& sheet, Mesh mesh, int n) {
  Disc disc = clampedDisc(sheet, mesh, n);
  const auto across = [&] {
    const Eigen::VectorXd diagonal =
        networkTangent(disc.network, disc.network.points).diagonal().cwiseAbs();
    double largest = 0.0;
    for (Eigen::Index i = 2; i < diagonal.size(); i += 3) largest = std::max(largest, diagonal[i]);
    return largest;
  };
  const double preloaded = across();
  for (Spring& s : disc.network.springs) s.preload = 0.0;
  return across() / preloaded;
}

// Force on the middle over that of the linear plate, at deflections in thicknesses, ascending.
Eigen::VectorXd forceRatios(const Sheet& sheet, Mesh mesh, int n, bool preload,
                            const Eigen::VectorXd& thicknesses) {
  Disc disc = clampedDisc(sheet, mesh, n);
  if (!preload) {
    for (Spring& s : disc.network.springs) s.preload = 0.0;
  }
  NetworkLoads loads = noLoads(disc.network);
  loads.free = disc.free;
  loads.free(2, disc.middle) = 0.0;
  Eigen::VectorXd ratios(thicknesses.size());
  Points x = disc.network.points;
  double before = 0.0;
  for (Eigen::Index k = 0; k < thicknesses.size(); ++k) {
    const double w = thicknesses[k] * sheet.thickness, linear = plate(sheet) * w;
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      const double cone = std::max(0.0, 1.0 - disc.network.points.col(i).norm() / kRadius);
      if (disc.free(2, i) != 0.0) x(2, i) = before > 0.0 ? x(2, i) * w / before : w * cone;
    }
    comeToRest(disc.network, loads, 1e-6 * linear, &x, 1000);
    ratios[k] = -networkForces(disc.network, x)(2, disc.middle) / linear;
    before = w;
  }
  return ratios;
}

}  // namespace

std::string discs(bool quick) {
  const Sheet sheet{1.0e7, 0.3, kThickness}, third{1.0e7, 1.0 / 3.0, kThickness};
  const int finest = quick ? 4 : 32, bent = quick ? 2 : 8;
  std::vector<double> n, triangles, squares, bare;
  for (int i = 1; i <= finest; i *= 2) {
    n.push_back(i);
    triangles.push_back(linearRatio(sheet, Mesh::kTriangles, i));
    squares.push_back(linearRatio(sheet, Mesh::kSquares, i));
    bare.push_back(std::max(resistanceWithoutPreload(sheet, Mesh::kTriangles, i),
                            resistanceWithoutPreload(sheet, Mesh::kSquares, i)));
  }
  const auto list = [](const std::vector<double>& v) {
    return io::json(Eigen::Map<const Eigen::VectorXd>(v.data(), Eigen::Index(v.size())));
  };
  io::JsonMembers out, large;
  out.add("n", list(n));
  out.add("triangles", list(triangles));
  out.add("squares", list(squares));
  out.add("without_preload", list(bare));
  out.add("triangles_of_one_third", linearRatio(third, Mesh::kTriangles, finest));
  out.add("squares_of_one_third", linearRatio(third, Mesh::kSquares, finest));

  const Eigen::VectorXd thicknesses =
      (Eigen::VectorXd(8) << .25, .5, 1, 1.5, 2, 3, 4, 5).finished();
  large.add("n", bent);
  large.add("thicknesses", io::json(thicknesses));
  const auto add = [&](const std::string& name, Mesh mesh, bool preload) {
    large.add(name, io::json(forceRatios(sheet, mesh, bent, preload, thicknesses)));
  };
  add("triangles", Mesh::kTriangles, true);
  add("squares", Mesh::kSquares, true);
  add("triangles_without_preload", Mesh::kTriangles, false);
  add("squares_without_preload", Mesh::kSquares, false);
  add("bending_triangles", Mesh::kBendingTriangles, true);
  add("bending_triangles_without_preload", Mesh::kBendingTriangles, false);
  // Up to one spacing, which is 100 thicknesses and more.
  const double spacing = kRadius / bent / kThickness;
  const Eigen::VectorXd spacings = (Eigen::VectorXd(4) << .05, .2, .5, 1.0).finished();
  large.add("spacings", io::json(spacings));
  large.add("bending_triangles_by_spacings",
            io::json(forceRatios(sheet, Mesh::kBendingTriangles, bent, true, spacing * spacings)));
  large.add("bending_triangles_without_preload_by_spacings",
            io::json(forceRatios(sheet, Mesh::kBendingTriangles, bent, false, spacing * spacings)));
  out.add("large", large.object());
  return out.object();
}

}  // namespace palpate::models
