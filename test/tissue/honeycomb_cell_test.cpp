// SPDX-License-Identifier: GPL-3.0-or-later
// One cell of a honeycomb: balance and volume whatever its active sides are, both volume
// conditions, and how it turns, by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "honeycomb_block.h"
#include "tissue/models/honeycomb/side_feedback.h"

namespace palpate::tissue::honeycomb_cell_test {
namespace {

using test::HoneycombBlock;

const Vec3 kSize(0.01, 0.012, 0.008);

// Its bottom is held, and is the first active side.
TEST(HoneycombCell, BalancesForAnyNumberOfActiveSides) {
  std::mt19937 rng{20050801};
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (const bool exact : {false, true}) {
    for (int active = 0; active < 31; ++active) {  // with all six nothing is left to solve for
      HoneycombBlock block({1, 1, 1}, kSize, HoneycombBlock::glued, exact);
      const auto& sides = block.lattice.cells[0].sides;
      std::array<bool, 6> passive{};
      for (std::size_t k = 0; k < 6; ++k) {
        passive[k] = k != 4;
        block.control.side_loads[sides[k]] = 1e-3 * u(rng);
      }
      for (int bit = 0, k = 0; k < 6; ++k) {
        if (k == 4) continue;
        if (active >> bit++ & 1) {
          passive[static_cast<std::size_t>(k)] = false;
          block.state.sides[sides[static_cast<std::size_t>(k)]] = 4e-4 * u(rng);
        }
      }
      block.balance.solveCell(0, passive, block.control.side_loads, exact ? 200 : 1, &block.state);
      const double scale = block.fabric.stretch[0].maxCoeff() * 4e-4;
      for (std::size_t k = 0; k < 6; ++k) {
        if (!passive[k]) continue;
        EXPECT_LE(std::abs(block.force(sides[k])), 1e-12 * scale) << active;
      }
      EXPECT_LE(std::abs(block.balance.volumeError(block.state, 0)), 1e-12 * block.lattice.volume())
          << active << " " << exact;
    }
  }
}

// Half the strain leaves a quarter of the error.
TEST(HoneycombCell, LinearVolumesAreWrongBySecondOrder) {
  double errors[2] = {}, differences[2] = {};
  for (int half = 0; half < 2; ++half) {
    const double pressed = -0.05 * kSize.z() / (1 + half);
    HoneycombBlock linear({1, 1, 1}, kSize, HoneycombBlock::glued);
    HoneycombBlock exact({1, 1, 1}, kSize, HoneycombBlock::glued, true);
    for (HoneycombBlock* block : {&linear, &exact}) {
      block->prescribe(block->lattice.cells[0].sides[5], pressed);
      const std::array<bool, 6> passive{true, true, true, true, false, false};
      block->balance.solveCell(0, passive, block->control.side_loads, 200, &block->state);
    }
    errors[half] = linear.balance.edges(linear.state, 0).prod() / linear.lattice.volume() - 1.0;
    differences[half] = (linear.state.sides - exact.state.sides).norm();
  }
  EXPECT_NEAR(errors[0] / errors[1], 4.0, 0.3);
  EXPECT_NEAR(differences[0] / differences[1], 4.0, 0.3);
  std::printf("volume of a cell pressed by 5 %%: %.4f %% off\n", 100.0 * errors[0]);
}

// Two cells on each other along axis 3; the lower one stands on what is held. Tangential forces on
// the upper one's corners, along axis 2, turn it about axis 1: T = -F l_3 / 2 (3.12), against
// (3.16) of the neighbour. The outer walls have half the fabric, so that each wall's t is G V / (2
// l^2), and twice that to what is held, half a cell away.
TEST(HoneycombCell, TurnsAsByHand) {
  HoneycombBlock block({1, 1, 2}, kSize, HoneycombBlock::glued);
  const double F = 0.03, G = HoneycombBlock::kG, V = kSize.prod();
  Points forces = Points::Zero(3, block.lattice.corners.cols());
  for (Eigen::Index i = 0; i < forces.cols(); ++i) {
    if (block.lattice.corners(2, i) > 1.9 * kSize.z()) forces(1, i) = F / 4.0;
  }
  block.map.pull(forces, &block.control.side_loads, &block.control.turn_loads);
  const double T = -F * kSize.z() / 2.0;
  EXPECT_NEAR(block.control.turn_loads[3], T, 1e-15);
  EXPECT_NEAR(block.control.turn_loads[4], 0.0, 1e-15);
  EXPECT_NEAR(block.control.turn_loads[5], 0.0, 1e-15);

  ASSERT_GT(block.solve(1e-16), 0);
  const double k = 2.0 * G * V / std::pow(kSize.z(), 2), t = 0.5 * G * V / std::pow(kSize.z(), 2);
  const double bending = 2.0 * k * std::pow(kSize.y(), 2) / 24.0;
  const double neighbour = bending + std::pow(kSize.z(), 2) / 2.0 * 2.0 * t;
  const double held = bending + std::pow(kSize.z(), 2) / 2.0 * 2.0 * (2.0 * t);
  EXPECT_NEAR(block.state.turns[0], T / held, 1e-12 * std::abs(T / held));
  EXPECT_NEAR(block.state.turns[3], T / held + T / neighbour, 1e-12 * std::abs(T / held));
  // About its other axes nothing turns it.
  EXPECT_NEAR(block.state.turns[4], 0.0, 1e-15);

  // Twisted about axis 3, it is held by (3.17): both pairs of walls, with the arms of the other
  // axis.
  block.state = block.balance.rest();
  block.control.turn_loads.setZero();
  block.control.turn_loads[5] = 1e-5;
  ASSERT_GT(block.solve(1e-16), 0);
  const double twist = 2.0 * t * (std::pow(kSize.x(), 2) + std::pow(kSize.y(), 2)) / 6.0;
  EXPECT_NEAR(block.state.turns[5] - block.state.turns[2], 1e-5 / twist, 1e-10 * 1e-5 / twist);
}

TEST(HoneycombCell, CornersDoWorkWithSidesAndTurns) {
  HoneycombBlock block({2, 2, 2}, kSize, HoneycombBlock::glued);
  std::srand(3);
  const Points f = Points::Random(3, block.lattice.corners.cols());
  CellState d = block.balance.rest();
  d.sides.setRandom();
  for (int s = 0; s < block.lattice.numSides(); ++s) {
    if (block.held.along_normal[static_cast<std::size_t>(s)]) d.sides[s] = 0.0;
  }
  d.turns.setRandom();
  Points moved;
  block.map.place(d, &moved);
  moved -= block.map.rest();
  Eigen::VectorXd sides = Eigen::VectorXd::Zero(d.sides.size());
  Eigen::VectorXd turns = Eigen::VectorXd::Zero(d.turns.size());
  block.map.pull(f, &sides, &turns);
  EXPECT_NEAR(f.cwiseProduct(moved).sum(), sides.dot(d.sides) + turns.dot(d.turns), 1e-12);
  const Vec3 whole = f.rowwise().sum(), borne = block.map.borne(f);
  for (int a = 0; a < 3; ++a) {
    double taken = 0.0;
    for (int s = 0; s < block.lattice.numSides(); ++s) {
      if (block.lattice.sides[static_cast<std::size_t>(s)].axis == a) taken += sides[s];
    }
    EXPECT_NEAR(taken + borne[a], whole[a], 1e-12);
  }
}

// What is unbalanced on a side is the gradient of the energy, where volumes are right by pressures.
TEST(HoneycombCell, ForcesAreTheGradientOfTheEnergy) {
  for (const bool exact : {false, true}) {
    HoneycombBlock block({2, 1, 2}, kSize, HoneycombBlock::glued, exact, Vec3(1e-3, 2e-3, -3e-3));
    std::srand(5);
    block.state.sides = 5e-4 * Eigen::VectorXd::Random(block.state.sides.size());
    block.state.pressures = 100.0 * Eigen::VectorXd::Random(block.state.pressures.size());
    block.state.turns = 0.1 * Eigen::VectorXd::Random(block.state.turns.size());
    const auto energy = [&](const CellState& s) {
      double e = block.balance.elasticEnergy(s) - block.balance.weights().dot(s.sides);
      for (int c = 0; c < block.lattice.numCells(); ++c) {
        e -= s.pressures[c] * block.balance.volumeError(s, c);
      }
      return e;
    };
    const double h = 1e-7;
    for (int s = 0; s < block.lattice.numSides(); ++s) {
      CellState up = block.state, down = block.state;
      up.sides[s] += h;
      down.sides[s] -= h;
      EXPECT_NEAR(block.balance.force(block.state, s), -(energy(up) - energy(down)) / (2.0 * h),
                  1e-7);
    }
    for (int t = 0; t < 3 * block.lattice.numCells(); ++t) {
      CellState up = block.state, down = block.state;
      up.turns[t] += 1e-5;
      down.turns[t] -= 1e-5;
      EXPECT_NEAR(block.balance.torque(block.state, t), -(energy(up) - energy(down)) / 2e-5, 1e-9);
    }
  }
}

// The reaction of a pressed side is what (3.20) says with the signs of (3.8): the fluid's pressure
// less the walls' tension. As printed it is off by twice the walls' part.
TEST(HoneycombCell, PressesBackByFluidAndWalls) {
  HoneycombBlock block({1, 1, 1}, kSize, HoneycombBlock::glued, false, Vec3(0, 0, -4e-3));
  const int top = block.lattice.cells[0].sides[5];
  const double pressed = -0.05 * kSize.z();
  block.prescribe(top, pressed);
  block.balance.solveCell(0, {true, true, true, true, false, false}, block.control.side_loads, 1,
                          &block.state);
  const double k = block.fabric.stretch[0].z(), P = block.state.pressures[0];
  const double fluid = P * kSize.x() * kSize.y(), walls = k * pressed;
  const double N = sideReaction(block.balance, block.state, top);
  EXPECT_NEAR(N, fluid - walls - 2e-3, 1e-15);
  EXPECT_NEAR(printedSideReaction(block.balance, block.state, top), fluid + walls + 2e-3, 1e-15);
  EXPECT_GT(N, 0.0);
  std::printf("one cell pressed by 5 %%: %.4f N, as printed %.4f N\n", N,
              printedSideReaction(block.balance, block.state, top));

  // No slip: the tool's place goes 1 mm along axis 1 past the cell; it is drawn back by t.
  const double t = HoneycombBlock::kG * kSize.prod() / std::pow(kSize.z(), 2);
  const double middle = 0.5 * (block.state.sides[block.lattice.cells[0].sides[0]] +
                               block.state.sides[block.lattice.cells[0].sides[1]]);
  EXPECT_NEAR(noSlipFriction(block.balance, block.state, top, 0, middle + 1e-3, 0.25),
              -0.25 * t * 1e-3, 1e-12 * t);
}

}  // namespace
}  // namespace palpate::tissue::honeycomb_cell_test
