// SPDX-License-Identifier: GPL-3.0-or-later
#include "cell_balance.h"

#include <algorithm>
#include <cmath>

namespace palpate::tissue {

CellBalance::CellBalance(const CellLattice& lattice, const CellFabric& fabric,
                         const HeldSides& held, const Points& weight, bool exact)
    : lattice_(lattice), fabric_(fabric), held_(held), exact_(exact) {
  weights_.setZero(lattice.numSides());
  for (int s = 0; s < lattice.numSides(); ++s) {
    const CellLattice::Side& side = lattice.sides[static_cast<std::size_t>(s)];
    for (const int c : side.cells) {
      if (c >= 0) weights_[s] += 0.5 * weight(side.axis, c);
    }
  }
}

CellState CellBalance::rest() const {
  return {Eigen::VectorXd::Zero(lattice_.numSides()), Eigen::VectorXd::Zero(lattice_.numCells()),
          Eigen::VectorXd::Zero(3 * lattice_.numCells())};
}

Vec3 CellBalance::edges(const CellState& state, int cell) const {
  const auto& sides = lattice_.cells[static_cast<std::size_t>(cell)].sides;
  return lattice_.size + Vec3(state.sides[sides[1]] - state.sides[sides[0]],
                              state.sides[sides[3]] - state.sides[sides[2]],
                              state.sides[sides[5]] - state.sides[sides[4]]);
}

Vec3 CellBalance::areas(const CellState& state, int cell) const {
  const Vec3 L = exact_ ? edges(state, cell) : lattice_.size;
  return {L.y() * L.z(), L.z() * L.x(), L.x() * L.y()};
}

double CellBalance::volumeError(const CellState& state, int cell) const {
  const Vec3 L = edges(state, cell);
  if (exact_) return L.prod() - lattice_.volume();
  return areas(state, cell).dot(L - lattice_.size);
}

double CellBalance::force(const CellState& state, int s) const {
  const auto number = static_cast<std::size_t>(s);
  const CellLattice::Side& side = lattice_.sides[number];
  const double d = state.sides[s];
  double force = weights_[s] - fabric_.shear_to_held[s] * d;
  for (const Coupling& c : fabric_.shear[number]) {
    force += c.stiffness * (state.sides[c.other] - d);
  }
  for (std::size_t b = 0; b < 2; ++b) {
    const int cell = side.cells[b];
    if (cell < 0) continue;
    const auto& ends = lattice_.cells[static_cast<std::size_t>(cell)].sides;
    const auto k = static_cast<std::size_t>(2 * side.axis);
    const double longer = state.sides[ends[k + 1]] - state.sides[ends[k]];
    const double area =
        exact_ ? areas(state, cell)[side.axis] : lattice_.volume() / lattice_.size[side.axis];
    const double out = state.pressures[cell] * area -
                       fabric_.stretch[static_cast<std::size_t>(cell)][side.axis] * longer;
    force += b == 0 ? out : -out;
  }
  return force;
}

double CellBalance::torque(const CellState& state, int turn) const {
  const double angle = state.turns[turn];
  double torque = -fabric_.turning_to_held[turn] * angle;
  for (const Coupling& c : fabric_.turning[static_cast<std::size_t>(turn)]) {
    torque += c.stiffness * (state.turns[c.other] - angle);
  }
  return torque;
}

double CellBalance::elasticEnergy(const CellState& state) const {
  double twice = 0.0;
  for (int c = 0; c < lattice_.numCells(); ++c) {
    const Vec3 longer = edges(state, c) - lattice_.size;
    twice += fabric_.stretch[static_cast<std::size_t>(c)].dot(longer.cwiseAbs2());
  }
  const auto add = [&twice](const std::vector<std::vector<Coupling>>& couplings,
                            const Eigen::VectorXd& to_held, const Eigen::VectorXd& y) {
    twice += to_held.dot(y.cwiseAbs2());
    for (Eigen::Index a = 0; a < y.size(); ++a) {
      for (const Coupling& c : couplings[static_cast<std::size_t>(a)]) {
        const double difference = y[c.other] - y[a];
        twice += 0.5 * c.stiffness * difference * difference;  // each is met twice
      }
    }
  };
  add(fabric_.shear, fabric_.shear_to_held, state.sides);
  add(fabric_.turning, fabric_.turning_to_held, state.turns);
  return 0.5 * twice;
}

double CellBalance::leastRatio(const CellState& state) const {
  double least = 1.0;
  for (int c = 0; c < lattice_.numCells(); ++c) {
    const Vec3 ratio = edges(state, c).cwiseQuotient(lattice_.size);
    least = std::min({least, ratio.minCoeff(), ratio.prod()});
  }
  return least;
}

double CellBalance::solveCell(int cell, const std::array<bool, 6>& passive,
                              const Eigen::VectorXd& load, int steps, CellState* state) const {
  const auto& sides = lattice_.cells[static_cast<std::size_t>(cell)].sides;
  const Vec3& k = fabric_.stretch[static_cast<std::size_t>(cell)];
  double change = 0.0;
  for (int step = 0; step < steps; ++step) {
    // Each axis has two unknowns: their answers to the forces that are left, and to a pressure.
    Eigen::Matrix<double, 6, 1> y = Eigen::Matrix<double, 6, 1>::Zero(), z = y;
    const Vec3 area = areas(*state, cell);
    double volume = volumeError(*state, cell), by_pressure = 0.0;
    for (int a = 0; a < 3; ++a) {
      Eigen::Vector2d r = Eigen::Vector2d::Zero(), out = r;
      Eigen::Matrix2d K = Eigen::Matrix2d::Identity();
      for (int e = 0; e < 2; ++e) {
        const auto n = static_cast<std::size_t>(2 * a + e);
        if (!passive[n]) continue;
        r[e] = force(*state, sides[n]) + load[sides[n]];
        out[e] = (e == 0 ? -1.0 : 1.0) * area[a];
        K(e, e) = fabric_.diagonal[sides[n]];
      }
      if (out[0] != 0.0 && out[1] != 0.0) K(0, 1) = K(1, 0) = -k[a];
      const double det = K(0, 0) * K(1, 1) - K(0, 1) * K(1, 0);
      Eigen::Matrix2d inverse;
      inverse << K(1, 1), -K(0, 1), -K(1, 0), K(0, 0);
      inverse /= det;
      y.segment<2>(2 * a) = inverse * r;
      z.segment<2>(2 * a) = inverse * out;
      volume += out.dot(y.segment<2>(2 * a));
      by_pressure += out.dot(z.segment<2>(2 * a));
    }
    if (!(by_pressure > 0.0)) return 0.0;
    const double pressure = -volume / by_pressure;
    y += pressure * z;
    state->pressures[cell] += pressure;
    for (std::size_t n = 0; n < 6; ++n) {
      state->sides[sides[n]] += y[static_cast<Eigen::Index>(n)];
    }
    change = std::max(change, y.cwiseAbs().maxCoeff());
  }
  return change;
}

void CellBalance::solveTurns(int cell, const std::vector<bool>& controlled,
                             const Eigen::VectorXd& load, CellState* state) const {
  for (int turn = 3 * cell; turn < 3 * cell + 3; ++turn) {
    const double stiffness = fabric_.turning_diagonal[turn];
    if (stiffness > 0.0 && !controlled[static_cast<std::size_t>(turn)]) {
      state->turns[turn] += (torque(*state, turn) + load[turn]) / stiffness;
    }
  }
}

}  // namespace palpate::tissue
