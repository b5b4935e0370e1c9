// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "bem/surface_operators.h"
#include "palpate/bem/known_bodies.h"
#include "palpate/bem/plane_plate.h"
#include "palpate/io/json.h"
#include "parts.h"

namespace palpate::models {
namespace {

std::string list(const std::vector<std::string>& items) {
  std::string text;
  for (const std::string& item : items) text += (text.empty() ? "" : ", ") + item;
  return "[" + text + "]";
}

// Displacements at the elements' middles and inside, where both have points.
std::string plate(int per_side, const bem::PlateOfTriangles& triangles, int cells) {
  const bem::PlateOfElements plate = bem::plateOfElements({}, per_side);
  const double most = triangles.displacement.cwiseAbs().maxCoeff();
  double off = 0.0, inside = 0.0;
  for (Eigen::Index i = 0; i < (cells + 1) * (cells + 1); ++i) {
    const Eigen::Vector2d X = triangles.points.col(i), u = triangles.displacement.col(i);
    for (Eigen::Index k = 0; k < plate.elements.size(); ++k) {
      if ((plate.elements.middles().col(k) - X).norm() > 1e-9) continue;
      off = std::max(off, (plate.solution.displacement.col(k) - u).norm());
    }
    if (X.minCoeff() > 0.19 && X.maxCoeff() < 0.81) {
      inside = std::max(inside, (plate.elements.displacement(X, plate.solution) - u).norm());
    }
  }
  io::JsonMembers out;
  out.add("elements", 4.0 * per_side);
  out.add("unknowns", static_cast<double>(plate.elements.displacementMatrix().rows()));
  out.add("entries", static_cast<double>(plate.elements.displacementMatrix().size()));
  out.add("end", plate.solution.displacement(0, per_side + per_side / 2));
  out.add("side", plate.solution.displacement(1, per_side));
  out.add("off", off / most);
  out.add("inside", inside / most);
  return out.object();
}

std::string comparedPlates(bool quick) {
  const int cells = quick ? 10 : 50;
  const bem::PlateOfTriangles coarse = bem::plateOfTriangles({}, 10),
                              fine = bem::plateOfTriangles({}, cells);
  int nonzero = 0;
  for (Eigen::Index k = 0; k < coarse.matrix.nonZeros(); ++k) {
    nonzero += std::abs(coarse.matrix.valuePtr()[k]) > 1e-9 * coarse.matrix.coeff(0, 0);
  }
  const auto end = [](const bem::PlateOfTriangles& t, int n) {
    return t.displacement(0, n / 2 * (n + 1) + n);
  };
  io::JsonMembers out;
  out.add("triangles", static_cast<double>(coarse.triangles.cols()));
  out.add("unknowns", static_cast<double>(coarse.matrix.rows()));
  out.add("entries", static_cast<double>(coarse.matrix.nonZeros()));
  out.add("nonzero", static_cast<double>(nonzero));
  out.add("end", end(coarse, 10));
  out.add("fine_triangles", static_cast<double>(fine.triangles.cols()));
  out.add("fine_end", end(fine, cells));
  out.add("beside_coarse", plate(5, coarse, 10));
  std::vector<std::string> more;
  for (const int n : quick ? std::vector<int>{5} : std::vector<int>{5, 25}) {
    more.push_back(plate(n, fine, cells));
  }
  out.add("beside_fine", list(more));
  return out.object();
}

template <class Body>
std::string levels(const Body& body, const std::vector<int>& all) {
  std::vector<std::string> items;
  for (const int level : all) {
    const auto begin = std::chrono::steady_clock::now();
    const bem::KnownBody made = body(level);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    io::JsonMembers out;
    out.add("points", static_cast<double>(made.points));
    out.add("triangles", static_cast<double>(made.triangles));
    out.add("edge", made.edge);
    out.add("error", made.error);
    out.add("stress", made.stress);
    out.add("skew", made.skew);
    out.add("rigid", made.rigid);
    out.add("seconds", time.count());
    items.push_back(out.object());
  }
  return list(items);
}

// Seconds that the integrals of all pairs of triangles of a cavity take.
double integralSeconds(const material::Moduli& m, int level) {
  const mesh::SurfaceMesh cavity = bem::sphere(level, 1.0, false);
  const auto begin = std::chrono::steady_clock::now();
  bem::surfaceOperators(cavity, bem::trianglesOf(cavity), m, nullptr);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

std::string boundary(bool quick) {
  const double nu = 0.3;
  const material::Moduli m = material::moduliFromYoung(1.0, nu);
  const auto upTo = [&](int from, int to) {
    std::vector<int> found;
    for (int level = from; level <= (quick ? from + 1 : to); ++level) found.push_back(level);
    return found;
  };
  io::JsonMembers out(",\n");
  out.add("plate", comparedPlates(quick));
  out.add("cube", levels([&](int n) { return bem::cubeInTension(m, n); }, upTo(2, 6)));
  out.add("hollow", levels([&](int n) { return bem::hollowSphere(m, n); }, upTo(0, 2)));
  out.add("cavity", levels([&](int n) { return bem::sphericalCavity(m, n); }, upTo(0, 3)));
  out.add("integral_seconds", integralSeconds(m, quick ? 1 : 3));
  out.add("cavity_stress", bem::cavityStress(nu));
  return out.object();
}

}  // namespace palpate::models
