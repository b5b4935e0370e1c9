// SPDX-License-Identifier: GPL-3.0-or-later
// Columns and blocks of cells against closed forms of the solid that the walls stand for; the waves
// against a dense solve of the same equations, and what the cut-off costs.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numeric>

#include "honeycomb_block.h"
#include "tissue/models/honeycomb/side_feedback.h"

namespace palpate::tissue::honeycomb_lattice_test {
namespace {

using test::HoneycombBlock;

const Vec3 kSize(0.01, 0.012, 0.008);
constexpr double kG = HoneycombBlock::kG;

// Pulled without restraint aside: Young's modulus 3 G, edges across thinner by half.
TEST(HoneycombLattice, ColumnAndBlockStretchAsTheSolid) {
  for (const Eigen::Vector3i& n : {Eigen::Vector3i(1, 1, 4), Eigen::Vector3i(3, 2, 4)}) {
    const Vec3 extent = kSize.cwiseProduct(n.cast<double>());
    const double pulled = 0.01 * extent.z(), area = extent.x() * extent.y();
    HoneycombBlock moved(n, kSize, HoneycombBlock::mirrored);
    for (const int s : moved.top()) moved.prescribe(s, pulled);
    ASSERT_GT(moved.solve(1e-16), 0);
    double force = 0.0;
    for (const int s : moved.top()) force -= sideReaction(moved.balance, moved.state, s);
    EXPECT_NEAR(force, 3.0 * kG * 0.01 * area, 1e-10 * force);
    for (int s = 0; s < moved.lattice.numSides(); ++s) {
      const int axis = moved.lattice.sides[static_cast<std::size_t>(s)].axis;
      const double strain = axis == 2 ? 0.01 : -0.005;
      EXPECT_NEAR(moved.state.sides[s], strain * moved.middle(s)[axis], 1e-10 * pulled);
    }

    HoneycombBlock loaded(n, kSize, HoneycombBlock::mirrored);
    const double stress = 30.0;
    for (const int s : loaded.top()) loaded.control.side_loads[s] = stress * kSize.x() * kSize.y();
    ASSERT_GT(loaded.solve(1e-16), 0);
    for (const int s : loaded.top()) {
      EXPECT_NEAR(loaded.state.sides[s], stress / (3.0 * kG) * extent.z(), 1e-10 * extent.z());
    }
  }
}

// Between walls the fluid alone bears, and nothing moves.
TEST(HoneycombLattice, BetweenWallsThePressureBearsAll) {
  const Eigen::Vector3i n(2, 2, 3);
  const Vec3 extent = kSize.cwiseProduct(n.cast<double>());
  HoneycombBlock block(n, kSize, [&](const Vec3& X) {
    const auto inner = [&](int a) { return X[a] > 1e-9 && X[a] < extent[a] - 1e-9; };
    return Vec3(inner(0), inner(1), X.z() > 1e-9);
  });
  for (const int s : block.top()) block.control.side_loads[s] = -50.0 * kSize.x() * kSize.y();
  ASSERT_GT(block.solve(1e-16), 0);
  EXPECT_LT(block.state.sides.cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((block.state.pressures.array() - 50.0).abs().maxCoeff(), 50.0 * 1e-10);
}

// A slab on what is held, dragged by a shear stress: G, and sides lie on a straight line.
TEST(HoneycombLattice, SlabShearsAsTheSolid) {
  const Eigen::Vector3i n(4, 3, 3);
  HoneycombBlock block(n, kSize, HoneycombBlock::glued);
  const double slope = 0.02;
  for (int s = 0; s < block.lattice.numSides(); ++s) {
    const auto& side = block.lattice.sides[static_cast<std::size_t>(s)];
    if (side.axis != 0 || block.middle(s).z() < (n.z() - 1) * kSize.z()) continue;
    const double part = side.cells[0] < 0 || side.cells[1] < 0 ? 0.5 : 1.0;
    block.control.side_loads[s] = part * kG * slope * kSize.x() * kSize.y();
  }
  const double whole = block.control.side_loads.sum();
  EXPECT_NEAR(whole, kG * slope * (4.0 * kSize.x()) * (3.0 * kSize.y()), 1e-12);
  ASSERT_GT(block.solve(1e-17), 0);
  for (int s = 0; s < block.lattice.numSides(); ++s) {
    const bool dragged = block.lattice.sides[static_cast<std::size_t>(s)].axis == 0;
    EXPECT_NEAR(block.state.sides[s], dragged ? slope * block.middle(s).z() : 0.0, 1e-10 * slope);
  }
}

// A column of fluid in soft walls: the weight is borne, pressure grows downwards.
TEST(HoneycombLattice, WeightIsBorneAndPressureGrowsDownwards) {
  const double weight = 1e-3;
  HoneycombBlock block({3, 3, 4}, kSize, HoneycombBlock::glued, false, Vec3(0, 0, -weight));
  ASSERT_GT(block.solve(1e-16), 0);
  double support = 0.0;
  for (int s = 0; s < block.lattice.numSides(); ++s) {
    const auto number = static_cast<std::size_t>(s);
    if (block.lattice.sides[number].axis != 2) continue;
    support -= block.fabric.shear_to_held[s] * block.state.sides[s];
    if (block.held.along_normal[number]) support -= block.force(s);
  }
  EXPECT_NEAR(support, 36.0 * weight, 1e-10 * 36.0 * weight);
  for (int c = 0; c < block.lattice.numCells(); ++c) {
    const int above = block.lattice.neighbour(c, 5);
    if (above < 0) continue;
    EXPECT_GT(block.state.pressures[c], block.state.pressures[above]);
  }
}

class Pressed : public ::testing::TestWithParam<bool> {
 protected:
  static void press(HoneycombBlock* block, int around = 0) {
    const Vec3 extent = block->lattice.corners.rowwise().maxCoeff();
    for (const int s : block->top()) {
      const Vec3 off = (block->middle(s) - 0.5 * extent).cwiseQuotient(block->lattice.size);
      if (std::abs(off.x()) < around + 0.1 && std::abs(off.y()) < around + 0.1) {
        block->prescribe(s, -0.001);
      }
    }
  }
};
INSTANTIATE_TEST_SUITE_P(Waves, Pressed, ::testing::Bool(),
                         [](const auto& of) { return of.param ? "Outward" : "ThereAndBack"; });

TEST_P(Pressed, IsSymmetricAndInBalance) {
  HoneycombBlock block({5, 5, 3}, Vec3::Constant(0.01), HoneycombBlock::glued);
  press(&block);
  ASSERT_GT(block.solve(1e-15, GetParam()), 0);
  const auto at = [&](const Vec3& middle, int axis) {
    for (int s = 0; s < block.lattice.numSides(); ++s) {
      if (block.lattice.sides[static_cast<std::size_t>(s)].axis == axis &&
          (block.middle(s) - middle).norm() < 1e-6) {
        return block.state.sides[s];
      }
    }
    ADD_FAILURE();
    return 0.0;
  };
  double control = 0.0;
  Vec3 support = Vec3::Zero();
  for (int s = 0; s < block.lattice.numSides(); ++s) {
    const auto number = static_cast<std::size_t>(s);
    const int axis = block.lattice.sides[number].axis;
    const Vec3 m = block.middle(s), mirrored(0.05 - m.x(), m.y(), m.z()),
               turned(m.y(), m.x(), m.z());
    EXPECT_NEAR(at(mirrored, axis), axis == 0 ? -block.state.sides[s] : block.state.sides[s],
                1e-10 * 0.001);
    EXPECT_NEAR(at(turned, axis == 2 ? 2 : 1 - axis), block.state.sides[s], 1e-10 * 0.001);
    support[axis] -= block.fabric.shear_to_held[s] * block.state.sides[s];
    if (block.held.along_normal[number]) {
      support[axis] -= block.force(s);
    } else if (block.control.sides[number]) {
      control += sideReaction(block.balance, block.state, s);
    }
  }
  EXPECT_GT(control, 0.0);
  EXPECT_LT((support - Vec3(0, 0, control)).norm(), 1e-10 * control);
}

// All unknowns and equations at once.
TEST_P(Pressed, ComesToWhatADenseSolveGives) {
  HoneycombBlock block({3, 3, 3}, Vec3::Constant(0.01), HoneycombBlock::glued, false,
                       Vec3(1e-4, 0, -1e-3));
  press(&block);
  block.control.turn_loads.setConstant(1e-6);
  std::vector<int> free;
  for (int s = 0; s < block.lattice.numSides(); ++s) {
    if (!block.control.sides[static_cast<std::size_t>(s)]) free.push_back(s);
  }
  const auto sides = static_cast<Eigen::Index>(free.size());
  const Eigen::Index cells = block.lattice.numCells(), size = sides + 4 * cells;
  const CellState begin = block.state;
  const auto put = [&](const Eigen::VectorXd& y) {
    CellState s = begin;
    for (Eigen::Index k = 0; k < sides; ++k) s.sides[free[static_cast<std::size_t>(k)]] = y[k];
    s.pressures = 1e5 * y.segment(sides, cells);
    s.turns = y.tail(3 * cells);
    return s;
  };
  const auto left = [&](const CellState& s) {
    Eigen::VectorXd r(size);
    for (Eigen::Index k = 0; k < sides; ++k) {
      r[k] = block.balance.force(s, free[static_cast<std::size_t>(k)]);
    }
    for (int c = 0; c < block.lattice.numCells(); ++c) {
      r[sides + c] = 1e5 * block.balance.volumeError(s, c);
    }
    for (int t = 0; t < 3 * cells; ++t) {
      r[sides + cells + t] = block.balance.torque(s, t) + block.control.turn_loads[t];
    }
    return r;
  };
  const Eigen::VectorXd at_zero = left(put(Eigen::VectorXd::Zero(size)));
  Eigen::MatrixXd K(size, size);
  for (Eigen::Index k = 0; k < size; ++k) {
    K.col(k) = left(put(Eigen::VectorXd::Unit(size, k))) - at_zero;
  }
  const CellState dense = put(K.fullPivLu().solve(-at_zero));
  const double threshold = 1e-12;
  const int waves = block.solve(threshold, GetParam());
  ASSERT_GT(waves, 0);
  EXPECT_LT((block.state.sides - dense.sides).cwiseAbs().maxCoeff(), 100.0 * threshold);
  EXPECT_LT((block.state.pressures - dense.pressures).cwiseAbs().maxCoeff(),
            100.0 * threshold * kG / 0.01);
  EXPECT_LT((block.state.turns - dense.turns).cwiseAbs().maxCoeff(), 100.0 * threshold / 0.01);

  // As published, without mixing: slower, and the same.
  HoneycombBlock plain({3, 3, 3}, Vec3::Constant(0.01), HoneycombBlock::glued, false,
                       Vec3(1e-4, 0, -1e-3));
  press(&plain);
  plain.control.turn_loads.setConstant(1e-6);
  const int plain_waves = plain.solve(threshold, GetParam(), 0.0, 0);
  ASSERT_GT(plain_waves, 0);
  EXPECT_LT((plain.state.sides - dense.sides).cwiseAbs().maxCoeff(), 1000.0 * threshold);
  std::printf("%d waves, %d without mixing\n", waves, plain_waves);
}

// The more is cut off the less is solved, and the farther it is off.
TEST_P(Pressed, CutOffLeavesOutWhatIsFar) {
  std::vector<double> errors;
  std::vector<int> solved;
  HoneycombBlock whole({9, 9, 5}, Vec3::Constant(0.01), HoneycombBlock::glued);
  press(&whole, 1);
  ASSERT_GT(whole.solve(1e-9, GetParam()), 0);
  const auto reaction = [](const HoneycombBlock& block) {
    double sum = 0.0;
    for (const int s : block.top()) {
      if (block.control.sides[static_cast<std::size_t>(s)]) {
        sum += sideReaction(block.balance, block.state, s);
      }
    }
    return sum;
  };
  for (const double cut_off : {1e-6, 1e-5, 1e-4}) {
    HoneycombBlock block({9, 9, 5}, Vec3::Constant(0.01), HoneycombBlock::glued);
    press(&block, 1);
    const int waves = block.solve(1e-9, GetParam(), cut_off);
    ASSERT_GT(waves, 0);
    errors.push_back((block.state.sides - whole.state.sides).cwiseAbs().maxCoeff());
    solved.push_back(block.solved / waves);
    std::printf("cut off %.0e m of 1 mm: %d of %d cells a wave, sides %.1e m off, force %.2f %%\n",
                cut_off, solved.back(), (GetParam() ? 1 : 2) * block.lattice.numCells(),
                errors.back(), 100.0 * (reaction(block) / reaction(whole) - 1.0));
  }
  for (std::size_t k = 1; k < errors.size(); ++k) {
    EXPECT_GE(errors[k], errors[k - 1]);
    EXPECT_LE(solved[k], solved[k - 1]);
  }
  EXPECT_LT(errors.back(), 1e-3);  // no more than the tool has moved
}

}  // namespace
}  // namespace palpate::tissue::honeycomb_lattice_test
