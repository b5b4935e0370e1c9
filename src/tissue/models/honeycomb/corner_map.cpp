// SPDX-License-Identifier: GPL-3.0-or-later
#include "corner_map.h"

#include <algorithm>
#include <array>

namespace palpate::tissue {
namespace {

constexpr int kFitSteps = 200;

}  // namespace

CornerMap::CornerMap(const CellLattice& lattice, const HeldSides& held,
                     const Eigen::Matrix3Xd& free, const Pose& X_WO)
    : num_sides_(lattice.numSides()),
      X_(X_WO * lattice.corners.colwise().homogeneous()),
      R_WO_(X_WO.linear()),
      arm_(0.5 * lattice.size.mean()) {
  const auto corners = static_cast<std::size_t>(lattice.corners.cols());
  std::vector<std::array<std::vector<int>, 3>> sides(corners);
  std::vector<std::vector<int>> cells(corners);
  for (int s = 0; s < lattice.numSides(); ++s) {
    const CellLattice::Side& side = lattice.sides[static_cast<std::size_t>(s)];
    for (const int i : side.corners) {
      sides[static_cast<std::size_t>(i)][static_cast<std::size_t>(side.axis)].push_back(s);
    }
  }
  for (int c = 0; c < lattice.numCells(); ++c) {
    for (const int i : lattice.cells[static_cast<std::size_t>(c)].corners) {
      cells[static_cast<std::size_t>(i)].push_back(c);
    }
  }
  surface_.assign(lattice.triangles.data(), lattice.triangles.data() + lattice.triangles.size());
  std::sort(surface_.begin(), surface_.end());
  surface_.erase(std::unique(surface_.begin(), surface_.end()), surface_.end());
  first_.push_back(0);
  for (std::size_t i = 0; i < corners; ++i) {
    for (int a = 0; a < 3; ++a) {
      if (free(a, static_cast<Eigen::Index>(i)) != 0.0) {
        const auto& around = sides[i][static_cast<std::size_t>(a)];
        for (const int s : around) {
          if (held.along_normal[static_cast<std::size_t>(s)]) continue;
          terms_.push_back({s, 1.0 / static_cast<double>(around.size())});
        }
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        for (const int cell : cells[i]) {
          const Vec3 arm =
              (lattice.corners.col(static_cast<Eigen::Index>(i)) - lattice.centre(cell)) /
              static_cast<double>(cells[i].size());
          terms_.push_back({num_sides_ + 3 * cell + b, arm[c]});
          terms_.push_back({num_sides_ + 3 * cell + c, -arm[b]});
        }
      }
      first_.push_back(static_cast<int>(terms_.size()));
    }
  }
}

void CornerMap::place(const CellState& state, Points* x) const {
  x->resize(3, X_.cols());
  const auto of = [&](int u) {
    return u < num_sides_ ? state.sides[u] : state.turns[u - num_sides_];
  };
  for (int i = 0; i < static_cast<int>(X_.cols()); ++i) x->col(i) = X_.col(i) + way(i, of);
}

void CornerMap::placeSurface(const CellState& state, Points* x) const {
  const auto of = [&](int u) {
    return u < num_sides_ ? state.sides[u] : state.turns[u - num_sides_];
  };
  for (const int i : surface_) x->col(i) = X_.col(i) + way(i, of);
}

void CornerMap::pull(const Points& f, Eigen::VectorXd* sides, Eigen::VectorXd* turns) const {
  for (int i = 0; i < static_cast<int>(X_.cols()); ++i) {
    if (f.col(i).isZero(0.0)) continue;
    const Vec3 f_O = R_WO_.transpose() * f.col(i);
    for (int a = 0; a < 3; ++a) {
      for (const Term* t = begin(i, a); t != end(i, a); ++t) {
        (t->unknown < num_sides_ ? (*sides)[t->unknown] : (*turns)[t->unknown - num_sides_]) +=
            t->weight * f_O[a];
      }
    }
  }
}

Vec3 CornerMap::borne(const Points& f) const {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < static_cast<int>(X_.cols()); ++i) {
    if (f.col(i).isZero(0.0)) continue;
    const Vec3 f_O = R_WO_.transpose() * f.col(i);
    for (int a = 0; a < 3; ++a) {
      double taken = 0.0;
      for (const Term* t = begin(i, a); t != end(i, a); ++t) {
        if (t->unknown < num_sides_) taken += t->weight;
      }
      sum[a] += (1.0 - taken) * f_O[a];
    }
  }
  return R_WO_ * sum;
}

// Conjugate gradients on the normal equations [Bjorck 1996, CGLS], turns by their arms.
void CornerMap::fit(const Points& x, CellState* state) const {
  state->sides.setZero();
  state->turns.setZero();
  state->pressures.setZero();
  CellState way = *state, slope = *state;
  const auto pullLeft = [&](const Points& left) {
    slope.sides.setZero();
    slope.turns.setZero();
    pull(left, &slope.sides, &slope.turns);
    slope.turns /= arm_ * arm_;
    return slope.sides.squaredNorm() + arm_ * arm_ * slope.turns.squaredNorm();
  };
  Points left = x - X_, moved;
  double square = pullLeft(left);
  const double enough = 1e-24 * square;
  way = slope;
  for (int k = 0; k < kFitSteps && square > enough; ++k) {
    place(way, &moved);
    moved -= X_;
    const double step = square / moved.squaredNorm();
    state->sides += step * way.sides;
    state->turns += step * way.turns;
    left -= step * moved;
    const double next = pullLeft(left);
    way.sides = slope.sides + next / square * way.sides;
    way.turns = slope.turns + next / square * way.turns;
    square = next;
  }
}

}  // namespace palpate::tissue
