// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "palpate/io/json.h"
#include "palpate/springs/spring_grids.h"
#include "parts.h"
#include "rest.h"

namespace palpate::models {
namespace {

using namespace springs;

constexpr double E = 1.0e7, h = 0.1, kLength = 32.0;

// 2 n spacings between the clamps, which hold two masses each.
double stiffnessRatio(const BeamSection& beam, int n) {
  const double U = kLength / (2 * n);
  const SpringNetwork line = lineNetwork(lineSprings(beam, U), U, 2 * n + 3, 1.0);
  NetworkLoads loads = noLoads(line);
  const Eigen::Index last = line.points.cols() - 1, middle = n + 1;
  for (const Eigen::Index i : {Eigen::Index{0}, Eigen::Index{1}, last - 1, last}) {
    loads.free.col(i).setZero();
  }
  loads.free.topRows<2>().setZero();
  loads.forces(2, middle) = 1.0;
  const auto moved = moveLinearly(line, loads);
  if (!moved) throw std::runtime_error("a beam that does not resist");
  return 1.0 / (*moved)(2, middle) / (192 * E * beam.second_moment / (kLength * kLength * kLength));
}

// How much shorter each spring of a free line of 30 masses is at rest, in spacings.
Eigen::VectorXd shortenings(const BeamSection& beam, double U, double k2) {
  const SpringNetwork line = lineNetwork(lineSprings(beam, U, k2), U, 30, 1.0);
  NetworkLoads loads = noLoads(line);
  loads.free.bottomRows<2>().setZero();
  loads.free(0, 15) = 0.0;
  Points x = line.points;
  comeToRest(line, loads, 1e-14 * E * beam.area, &x);
  return 1.0 - (x.row(0).tail(29) - x.row(0).head(29)).transpose().array() / U;
}

// Of springs along a row or a column of a free sheet.
Eigen::VectorXd shorteningsAlong(const Points& x, Eigen::Index first, Eigen::Index step, int count,
                                 double U) {
  Eigen::VectorXd s(count);
  for (int i = 0; i < count; ++i) {
    s[i] = 1.0 - (x.col(first + (i + 1) * step) - x.col(first + i * step)).norm() / U;
  }
  return s;
}

// A free sheet at rest in its plane.
Points atRest(const SpringNetwork& sheet, Eigen::Index pinned, double imbalance) {
  NetworkLoads loads = noLoads(sheet);
  loads.free.row(2).setZero();
  loads.free.col(pinned).setZero();
  loads.free(1, pinned + 1) = 0.0;
  Points x = sheet.points;
  comeToRest(sheet, loads, imbalance, &x);
  return x;
}

// Two rows of squares that may move along x only, between which every diagonal counts twice: an
// endless strip.
Eigen::VectorXd shorteningsOfStrip(const Sheet& sheet, double U) {
  RectangleSprings springs = rectangleSprings(sheet, U);
  springs.shear.preload *= 2.0;
  springs.shear.stiffness *= 2.0;
  const SpringNetwork strip = rectangleNetwork(springs, U, rectangleNodes(17, 2), 1.0);
  NetworkLoads loads = noLoads(strip);
  loads.free.bottomRows<2>().setZero();
  loads.free.col(8).setZero();
  Points x = strip.points;
  comeToRest(strip, loads, 1e-12 * springs.structural.preload, &x);
  return shorteningsAlong(x, 0, 1, 16, U);
}

}  // namespace

std::string beams(bool quick) {
  const BeamSection beam = rectangularSection(E, h, h);
  const int last = quick ? 16 : 64;
  Eigen::VectorXd n(last - 1), ratio(last - 1);
  for (int i = 2; i <= last; ++i) {
    n[i - 2] = i;
    ratio[i - 2] = stiffnessRatio(beam, i);
  }
  io::JsonMembers out;
  out.add("n", io::json(n));
  out.add("ratio", io::json(ratio));
  return out.object();
}

std::string ends(bool /*quick*/) {
  const double U = kLength / 29;
  const BeamSection beam = rectangularSection(E, h, h);
  io::JsonMembers out, decaying;
  out.add("beam_spacing", U);
  out.add("thickness", h);
  out.add("beam", io::json(shortenings(beam, U, 0.0)));
  for (const char* c : {"0.5", "1", "2", "4"}) {
    decaying.add(c, io::json(shortenings(beam, U, E * beam.area / U / (std::stod(c) + 4))));
  }
  out.add("beam_by_stiffness_ratio", decaying.object());
  const double spacing = 2.0;
  const Sheet sheet{E, 0.3, h};
  const SpringNetwork squares =
      rectangleNetwork(rectangleSprings(sheet, spacing), spacing, rectangleNodes(17, 13), 1.0);
  const SpringNetwork triangles =
      triangleNetwork(triangleSprings(sheet, spacing), spacing, triangleNodes(17, 15), 1.0);
  const double preload = rectangleSprings(sheet, spacing).structural.preload;
  out.add("sheet_spacing", spacing);
  out.add("strip", io::json(shorteningsOfStrip(sheet, spacing)));
  out.add("squares", io::json(shorteningsAlong(atRest(squares, 6 * 17 + 8, 1e-9 * preload), 6 * 17,
                                               1, 16, spacing)));
  out.add("triangles", io::json(shorteningsAlong(atRest(triangles, 7 * 17 + 8, 1e-9 * preload),
                                                 7 * 17, 1, 16, spacing)));
  return out.object();
}

}  // namespace palpate::models
