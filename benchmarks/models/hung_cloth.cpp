// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <vector>

#include "cloth_springs.h"
#include "palpate/io/json.h"
#include "parts.h"
#include "rest.h"

namespace palpate::models {
namespace {

using namespace springs;

constexpr double kImbalance = 1e-9;  // of the stiffness 4.0 at the distance 1

// At rest where two corners are held that are opposite, and all masses weigh `weight`: from a
// gentle fold, for a sheet without preload does not resist to leave its plane.
Points hang(const SpringNetwork& network, int side, double weight) {
  NetworkLoads loads = noLoads(network);
  loads.free.col(0).setZero();
  loads.free.rightCols<1>().setZero();
  loads.forces.row(2).setConstant(-weight);
  Points x = network.points;
  const Vec3 a = x.col(0), b = x.rightCols<1>();
  const Vec3 along = (b - a).normalized();
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const Vec3 way = Vec3(x.col(i)) - a;
    x(2, i) -= 0.2 * (way - way.dot(along) * along).norm();
  }
  x(2, 0) = x(2, side * side - 1) = 0.0;
  comeToRest(network, loads, kImbalance, &x, 20000);
  return x;
}

// Energy a mass of a sheet that is bent to a cylinder of curvature `rho`, far from its edges.
double bendingEnergy(const SpringNetwork& network, double rho) {
  Points x = network.points;
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    x(2, i) = (1.0 - std::cos(rho * x(1, i))) / rho;
    x(1, i) = std::sin(rho * x(1, i)) / rho;
  }
  const Vec3 low = network.points.rowwise().minCoeff(), high = network.points.rowwise().maxCoeff();
  double sum = 0.0;
  int masses = 0;
  const auto inner = [&](int i) {
    const Vec3 p = network.points.col(i);
    return (p - low).head<2>().minCoeff() > 2.5 && (high - p).head<2>().minCoeff() > 2.5;
  };
  for (int i = 0; i < network.points.cols(); ++i) masses += inner(i);
  for (const Spring& s : network.springs) {
    const double share = 0.5 * (inner(s.a) + inner(s.b));
    sum += share * springEnergy(s, (x.col(s.b) - x.col(s.a)).norm());
  }
  return sum / masses;
}

io::JsonMembers figures(const SpringNetwork& network, int side, double weight) {
  const Points x = hang(network, side, weight);
  // The corners that are not held, and what is between them when the sheet is flat.
  const Eigen::Index c = side - 1, d = static_cast<Eigen::Index>(side) * (side - 1);
  const double flat = (network.points.col(c) - network.points.col(d)).norm();
  const double diagonal = (network.points.col(0) - network.points.rightCols<1>()).norm();
  io::JsonMembers out;
  out.add("sag", -x.row(2).minCoeff() / diagonal);
  out.add("open", (x.col(c) - x.col(d)).norm() / flat);
  const Vec3 ends = x.col(0) + x.rightCols<1>();
  out.add("middle",
          (0.5 * ends - Vec3(x.col((static_cast<Eigen::Index>(side) * side - 1) / 2))).norm() /
              diagonal);
  for (int k = 0; k < 3; ++k) {
    out.add(std::string(1, "xyz"[k]), io::json(Eigen::VectorXd(x.row(k).transpose())));
  }
  return out;
}

}  // namespace

std::string hungCloth(bool quick) {
  const int side = quick ? 7 : 15;
  const SpringNetwork older = olderSheet(1.0, side, 1.0), newer = newerSheet(1.0, side, 1.0);
  const Eigen::VectorXd weights = (Eigen::VectorXd(3) << 0.005, 0.02, 0.08).finished();
  const Eigen::VectorXd curvatures = (Eigen::VectorXd(4) << 0.02, 0.05, 0.1, 0.2).finished();
  io::JsonMembers out;
  out.add("side", side);
  out.add("weights", io::json(weights));
  out.add("curvatures", io::json(curvatures));
  for (const auto& [name, network] : {std::pair("older", &older), std::pair("newer", &newer)}) {
    Eigen::VectorXd energies = curvatures;
    for (double& e : energies) e = bendingEnergy(*network, e) - bendingEnergy(*network, 1e-9);
    out.add(std::string(name) + "_bending", io::json(energies));
    std::string all;
    for (const double weight : weights) {
      all += (all.empty() ? "" : ", ") + figures(*network, side, weight).object();
    }
    out.add(name, "[" + all + "]");
  }
  return out.object();
}

}  // namespace palpate::models
