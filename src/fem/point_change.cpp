// SPDX-License-Identifier: GPL-3.0-or-later
#include "point_change.h"

#include <stdexcept>

#include "shape_functions.h"

namespace palpate::fem {
namespace {

using Quadratic = Tetrahedron<10>;

double sumOf(const std::vector<double>& volumes, mesh::MeshChange::Range range) {
  double sum = 0.0;
  for (int k = range.first; k < range.last; ++k) sum += volumes[k];
  return sum;
}

// L_q at w: linear, 1 at the rule's point q and 0 at the other three.
double fieldOf(int q, const Eigen::Vector4d& w) {
  const Eigen::Vector4d point = Quadratic::point(0);
  return (w[q] - point[1]) / (point[0] - point[1]);
}

}  // namespace

PointChange::PointChange(const mesh::MeshChange& change, int points_per_element,
                         const std::vector<double>& old_volumes)
    : points_per_element_(points_per_element) {
  if (points_per_element != (change.quadratic() ? Quadratic::kPoints : 1)) {
    throw std::invalid_argument("the mesh was one of other elements");
  }
  if (change.quadratic()) {
    addLinearFields(change, old_volumes);
  } else {
    addConstants(change, old_volumes);
  }
}

void PointChange::addConstants(const mesh::MeshChange& change,
                               const std::vector<double>& old_volumes) {
  for (const mesh::MeshChange::Range from : change.tets) {
    const double volume = sumOf(old_volumes, from);
    for (int k = from.first; k < from.last; ++k) {
      sources_.push_back({k, 0, old_volumes[k] / volume});
    }
    begin_.push_back(sources_.size());
  }
}

// Element values f_q define the linear field sum_q L_q(w) f_q. The rule of four points integrates
// products of two such fields exactly. So the nearest field to those of parts i, with volumes V_i,
// has the value sum_i V_i/V sum_q L_p(w_iq) f_iq at point p.
void PointChange::addLinearFields(const mesh::MeshChange& change,
                                  const std::vector<double>& old_volumes) {
  std::size_t pair = 0;
  for (const mesh::MeshChange::Range from : change.tets) {
    const bool joined = from.last > from.first + 1;
    const double volume = sumOf(old_volumes, from);
    for (int p = 0; p < Quadratic::kPoints; ++p) {
      for (int k = from.first; k < from.last; ++k) {
        const Eigen::Matrix4d& corners = change.corners[pair + (k - from.first)];
        const double share = old_volumes[k] / volume;
        for (int q = 0; q < Quadratic::kPoints; ++q) {
          const double weight = joined ? share * fieldOf(p, corners * Quadratic::point(q))
                                       : fieldOf(q, corners * Quadratic::point(p));
          if (weight != 0.0) sources_.push_back({k, q, weight});
        }
      }
      begin_.push_back(sources_.size());
    }
    pair += static_cast<std::size_t>(from.last - from.first);
  }
}

}  // namespace palpate::fem
