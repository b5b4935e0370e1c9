// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "tissue/models/honeycomb/cell_waves.h"
#include "tissue/models/honeycomb/corner_map.h"
#include "tissue/models/honeycomb/wave_mixing.h"

namespace palpate::test {

/// A box of cells from the origin along the axes, of one fabric.
class HoneycombBlock {
 public:
  using Free = std::function<Vec3(const Vec3& X)>;
  static constexpr double kG = 1000.0;  // [Pa]

  /// `free(X)`: of a corner, 1 or 0 along each axis; `weight`: of a cell [N].
  HoneycombBlock(const Eigen::Vector3i& n, const Vec3& size, const Free& free, bool exact = false,
                 const Vec3& weight = Vec3::Zero())
      : lattice(tissue::makeCellLattice(
            Vec3::Zero(), size, n, std::vector<bool>(static_cast<std::size_t>(n.prod()), true))),
        free_(mask(lattice, free)),
        held(tissue::heldSides(lattice, free_)),
        fabric(
            tissue::makeCellFabric(lattice, held, std::vector<double>(lattice.cells.size(), kG))),
        balance(lattice, fabric, held, weight.replicate(1, lattice.numCells()), exact),
        map(lattice, held, free_, Pose::Identity()) {
    control.reset(balance);
    state = balance.rest();
  }
  HoneycombBlock(const HoneycombBlock&) = delete;
  HoneycombBlock& operator=(const HoneycombBlock&) = delete;

  static Vec3 glued(const Vec3& X) { return X.z() <= 1e-9 ? Vec3::Zero() : Vec3::Ones(); }
  /// An eighth of a body that three planes mirror.
  static Vec3 mirrored(const Vec3& X) { return (X.array() > 1e-9).cast<double>(); }
  static Vec3 loose(const Vec3&) { return Vec3::Ones(); }

  void prescribe(int side, double displacement) {
    control.sides[static_cast<std::size_t>(side)] = true;
    state.sides[side] = displacement;
  }
  /// Outer sides on the positive side of an axis.
  std::vector<int> top(int axis = 2) const {
    std::vector<int> sides;
    for (int s = 0; s < lattice.numSides(); ++s) {
      const auto& side = lattice.sides[static_cast<std::size_t>(s)];
      if (side.axis == axis && side.cells[1] < 0) sides.push_back(s);
    }
    return sides;
  }
  Vec3 middle(int side) const {
    Vec3 sum = Vec3::Zero();
    for (const int i : lattice.sides[static_cast<std::size_t>(side)].corners) {
      sum += 0.25 * lattice.corners.col(i);
    }
    return sum;
  }
  double force(int side) const { return balance.force(state, side) + control.side_loads[side]; }

  /// Waves until sides change by no more than `change` [m]; how many.
  int solve(double change, bool outward = false, double cut_off = 0.0, int mixing = 10) {
    tissue::CellWaves waves(balance, outward, cut_off);
    waves.begin(false);
    waves.findFronts(control);
    const Eigen::Index sides = lattice.numSides(), cells = lattice.numCells();
    tissue::WaveMixing mix(sides + 4 * cells, mixing);
    const double pressure = lattice.size.mean() / kG, turn = lattice.size.mean();
    const auto pack = [&] {
      Eigen::VectorXd x(sides + 4 * cells);
      x << state.sides, pressure * state.pressures, turn * state.turns;
      return x;
    };
    Eigen::VectorXd moved = state.sides;
    for (int wave = 1; wave <= 2000; ++wave) {
      const Eigen::VectorXd before = pack();
      solved += waves.run(control, moved, &state);
      moved.setZero();
      Eigen::VectorXd after = pack();
      if ((after - before).cwiseAbs().maxCoeff() <= change) return wave;
      mix.mix(before, &after);
      state.sides = after.head(sides);
      state.pressures = after.segment(sides, cells) / pressure;
      state.turns = after.tail(3 * cells) / turn;
    }
    return -1;
  }

  tissue::CellLattice lattice;
  Eigen::Matrix3Xd free_;
  tissue::HeldSides held;
  tissue::CellFabric fabric;
  tissue::CellBalance balance;
  tissue::CornerMap map;
  tissue::CellControl control;
  tissue::CellState state;
  int solved = 0;

 private:
  static Eigen::Matrix3Xd mask(const tissue::CellLattice& lattice, const Free& free) {
    Eigen::Matrix3Xd mask(3, lattice.corners.cols());
    for (Eigen::Index i = 0; i < mask.cols(); ++i) mask.col(i) = free(lattice.corners.col(i));
    return mask;
  }
};

}  // namespace palpate::test
