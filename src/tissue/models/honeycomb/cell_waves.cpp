// SPDX-License-Identifier: GPL-3.0-or-later
#include "cell_waves.h"

#include <cmath>

namespace palpate::tissue {
namespace {

constexpr int kStepsOfACell = 2;  // of Newton's method in a wave, where volumes are exact

}  // namespace

void CellControl::reset(const CellBalance& balance) {
  sides = balance.held().along_normal;
  turns.assign(static_cast<std::size_t>(3 * balance.lattice().numCells()), false);
  side_loads.setZero(balance.lattice().numSides());
  turn_loads.setZero(3 * balance.lattice().numCells());
}

CellWaves::CellWaves(const CellBalance& balance, bool outward_only, double cut_off)
    : balance_(balance), outward_only_(outward_only), cut_off_(cut_off) {
  const auto cells = static_cast<std::size_t>(balance.lattice().numCells());
  order_.reserve(cells);
  front_.assign(cells, -1);
  reached_.assign(cells, false);
  pending_.assign(cells, 0.0);
}

void CellWaves::begin(bool whole) {
  std::fill(reached_.begin(), reached_.end(), whole || cut_off_ <= 0.0);
}

void CellWaves::findFronts(const CellControl& control) {
  const CellLattice& lattice = balance_.lattice();
  order_.clear();
  std::fill(front_.begin(), front_.end(), -1);
  const auto put = [this](int cell, int front) {
    if (front_[static_cast<std::size_t>(cell)] >= 0) return;
    front_[static_cast<std::size_t>(cell)] = front;
    order_.push_back(cell);
  };
  for (const bool by_held : {false, true}) {
    for (int c = 0; c < lattice.numCells() && (!by_held || order_.empty()); ++c) {
      for (const int s : lattice.cells[static_cast<std::size_t>(c)].sides) {
        const auto side = static_cast<std::size_t>(s);
        if (control.sides[side] && (by_held || !balance_.held().along_normal[side])) put(c, 0);
      }
    }
    if (!order_.empty()) break;
  }
  // What is connected to none of them goes last, each part from its first cell.
  std::size_t at = 0;
  for (int first = -1; first < lattice.numCells(); ++first) {
    if (first >= 0) put(first, 0);
    for (; at < order_.size(); ++at) {
      const int cell = order_[at];
      for (int k = 0; k < 6; ++k) {
        const int other = lattice.neighbour(cell, k);
        if (other >= 0) put(other, front_[static_cast<std::size_t>(cell)] + 1);
      }
    }
  }
}

void CellWaves::solve(int cell, const CellControl& control, CellState* state) {
  const CellLattice& lattice = balance_.lattice();
  const auto& sides = lattice.cells[static_cast<std::size_t>(cell)].sides;
  const auto number = static_cast<std::size_t>(cell);
  if (!reached_[number]) {
    if (!(pending_[number] >= cut_off_)) return;
    reached_[number] = true;
  }
  std::array<bool, 6> passive{}, own{};
  std::array<double, 6> before{};
  bool any = false;
  for (std::size_t k = 0; k < 6; ++k) {
    before[k] = state->sides[sides[k]];
    own[k] = passive[k] = !control.sides[static_cast<std::size_t>(sides[k])];
    const int other = lattice.neighbour(cell, static_cast<int>(k));
    if (outward_only_ && other >= 0 && front_[static_cast<std::size_t>(other)] < front_[number]) {
      passive[k] = false;
    }
    any = any || passive[k];
  }
  balance_.solveCell(cell, any ? passive : own, control.side_loads, kStepsOfACell, state);
  balance_.solveTurns(cell, control.turns, control.turn_loads, state);
  ++solved_;
  if (cut_off_ <= 0.0) return;
  pending_[number] = 0.0;
  for (std::size_t k = 0; k < 6; ++k) {
    const int other = lattice.neighbour(cell, static_cast<int>(k));
    if (other < 0) continue;
    pending_[static_cast<std::size_t>(other)] += std::abs(state->sides[sides[k]] - before[k]);
  }
}

int CellWaves::run(const CellControl& control, const Eigen::VectorXd& moved, CellState* state) {
  solved_ = 0;
  if (cut_off_ > 0.0) {
    for (int s = 0; s < balance_.lattice().numSides(); ++s) {
      for (const int c : balance_.lattice().sides[static_cast<std::size_t>(s)].cells) {
        if (c >= 0) pending_[static_cast<std::size_t>(c)] += std::abs(moved[s]);
      }
    }
  }
  for (const int cell : order_) solve(cell, control, state);
  if (!outward_only_) {
    for (auto cell = order_.rbegin(); cell != order_.rend(); ++cell) {
      solve(*cell, control, state);
    }
  }
  return solved_;
}

}  // namespace palpate::tissue
