// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact_sides.h"

#include <algorithm>
#include <cmath>

namespace palpate::tissue {
namespace {

constexpr int kMaxSteps = 12;
constexpr int kMaxSideSearches = 6;
constexpr double kPart = 0.1;   // of the tolerance that is left
constexpr double kHelp = 0.3;   // to which a step with earlier factors is to bring what is left
constexpr double kSteep = 0.5;  // of the first slope, which a step may end with

std::size_t index(int i) { return static_cast<std::size_t>(i); }

}  // namespace

ContactSides::ContactSides(const CellBalance& balance, const CornerMap& map,
                           const contact::ContactPotential& contact)
    : balance_(balance),
      map_(map),
      contact_(contact),
      num_sides_(balance.lattice().numSides()),
      local_(index(num_sides_ + 3 * balance.lattice().numCells()), -1),
      cell_local_(index(balance.lattice().numCells()), -1),
      trial_(balance.rest()) {}

void ContactSides::take(int unknown) {
  if (local_[index(unknown)] >= 0) return;
  local_[index(unknown)] = static_cast<int>(unknowns_.size());
  unknowns_.push_back(unknown);
}

void ContactSides::takeCells(int unknown) {
  if (unknown >= num_sides_) return;
  for (const int c : balance_.lattice().sides[index(unknown)].cells) {
    if (c < 0 || cell_local_[index(c)] >= 0) continue;
    cell_local_[index(c)] = static_cast<int>(cells_.size());
    cells_.push_back(c);
  }
}

// The unknowns that what touches acts on, and the other sides of their cells: without these the
// cells' volumes would let nothing move.
bool ContactSides::gather() {
  for (const int u : unknowns_) local_[index(u)] = -1;
  for (const int c : cells_) cell_local_[index(c)] = -1;
  unknowns_.clear();
  cells_.clear();
  for (const contact::Contact& c : contacts_) {
    for (int k = 0; k < 3; ++k) {
      if (c.touch.weights[k] == 0.0) continue;
      for (int a = 0; a < 3; ++a) {
        const int node = c.touch.nodes[k];
        for (auto t = map_.begin(node, a); t != map_.end(node, a); ++t) take(t->unknown);
      }
    }
  }
  num_touched_ = static_cast<int>(unknowns_.size());
  for (int k = 0; k < num_touched_; ++k) takeCells(unknowns_[index(k)]);
  for (const int c : cells_) {
    for (const int side : balance_.lattice().cells[index(c)].sides) {
      if (!balance_.held().along_normal[index(side)]) take(side);
    }
  }
  return num_touched_ > 0;
}

double ContactSides::internalForce(const CellState& state, int unknown) const {
  return unknown < num_sides_ ? balance_.force(state, unknown)
                              : balance_.torque(state, unknown - num_sides_);
}

// The gradient into g_; its norm, torques by half an edge, with what volumes lack [N].
double ContactSides::unbalanced(const CellState& state) {
  const int n = static_cast<int>(unknowns_.size());
  g_.resize(unknowns_.size());
  for (int i = 0; i < n; ++i) g_[index(i)] = -internalForce(state, unknowns_[index(i)]);
  for (const contact::Contact& c : contacts_) {
    const Vec3 f_O = map_.frame().transpose() * c.force_W;
    for (int k = 0; k < 3; ++k) {
      for (int a = 0; a < 3; ++a) {
        const int node = c.touch.nodes[k];
        for (auto t = map_.begin(node, a); t != map_.end(node, a); ++t) {
          const int local = local_[index(t->unknown)];
          if (local >= 0) g_[index(local)] += c.touch.weights[k] * t->weight * f_O[a];
        }
      }
    }
  }
  double square = 0.0;
  const double arm = 0.5 * balance_.lattice().size.minCoeff();
  for (int i = 0; i < n; ++i) {
    const double g = g_[index(i)] / (unknowns_[index(i)] < num_sides_ ? 1.0 : arm);
    square += g * g;
  }
  for (const int c : cells_) {  // what volumes want, as forces
    const double way = balance_.volumeError(state, c) / balance_.areas(state, c).minCoeff();
    const double force = way * balance_.fabric().stretch[index(c)].maxCoeff();
    square += force * force;
  }
  return std::sqrt(square);
}

void ContactSides::addContacts() {
  for (const contact::Contact& c : contacts_) {
    const Mat3 K = contact_.convexStiffness(c, contact_.stiffness(c));
    entries_.clear();
    for (int k = 0; k < 3; ++k) {
      if (c.touch.weights[k] == 0.0) continue;
      for (int a = 0; a < 3; ++a) {
        const int node = c.touch.nodes[k];
        for (auto t = map_.begin(node, a); t != map_.end(node, a); ++t) {
          entries_.push_back(
              {local_[index(t->unknown)], c.touch.weights[k] * t->weight * map_.frame().col(a)});
        }
      }
    }
    // Nodes share unknowns: each once.
    std::sort(entries_.begin(), entries_.end(),
              [](const Entry& a, const Entry& b) { return a.local < b.local; });
    std::size_t used = 0;
    for (std::size_t e = 1; e < entries_.size(); ++e) {
      if (entries_[e].local == entries_[used].local) {
        entries_[used].by += entries_[e].by;
      } else {
        entries_[++used] = entries_[e];
      }
    }
    entries_.resize(entries_.empty() ? 0 : used + 1);
    for (const Entry& a : entries_) {
      const Vec3 K_a = K * a.by;
      for (const Entry& b : entries_) {
        if (b.local > a.local) break;
        matrix_.stiffness(a.local, b.local) += K_a.dot(b.by);
      }
    }
  }
}

// The stiffness of the unknowns, and the cells' volumes by them.
void ContactSides::assemble(const CellState& state) {
  const int n = static_cast<int>(unknowns_.size());
  const CellFabric& fabric = balance_.fabric();
  matrix_.reset(n, static_cast<int>(cells_.size()));
  const auto couple = [&](int a, int other, double stiffness) {
    const int b = local_[index(other)];
    if (b >= 0 && b < a) matrix_.stiffness(a, b) -= stiffness;
  };
  for (int a = 0; a < n; ++a) {
    const int unknown = unknowns_[index(a)];
    if (unknown >= num_sides_) {
      const int turn = unknown - num_sides_;
      matrix_.stiffness(a, a) = fabric.turning_diagonal[turn];
      for (const Coupling& c : fabric.turning[index(turn)]) {
        couple(a, num_sides_ + c.other, c.stiffness);
      }
      continue;
    }
    matrix_.stiffness(a, a) = fabric.diagonal[unknown];
    for (const Coupling& c : fabric.shear[index(unknown)]) couple(a, c.other, c.stiffness);
    const CellLattice::Side& side = balance_.lattice().sides[index(unknown)];
    for (int b = 0; b < 2; ++b) {
      const int cell = side.cells[index(b)];
      if (cell < 0 || cell_local_[index(cell)] < 0) continue;
      const int other = balance_.lattice().cells[index(cell)].sides[index(2 * side.axis + b)];
      couple(a, other, fabric.stretch[index(cell)][side.axis]);
      const double area = balance_.areas(state, cell)[side.axis];
      matrix_.condition(cell_local_[index(cell)], a) += b == 0 ? area : -area;
    }
  }
  addContacts();
}

// Along y_: d/dt of the energy, with the pressures of `state`.
double ContactSides::slope(const CellState& state) const {
  double slope = 0.0;
  for (std::size_t i = 0; i < unknowns_.size(); ++i) {
    slope -= y_[i] * internalForce(state, unknowns_[i]);
  }
  for (const contact::Contact& c : contacts_) slope += c.force_W.dot(c.touch.of(d_));
  return slope;
}

// How the corners of these cells go by y_, d_.
void ContactSides::findWay() {
  d_.setZero(3, map_.rest().cols());
  const auto of = [this](int unknown) {
    const int local = local_[index(unknown)];
    return local < 0 ? 0.0 : y_[index(local)];
  };
  for (const int c : cells_) {
    for (const int i : balance_.lattice().cells[index(c)].corners) d_.col(i) = map_.way(i, of);
  }
}

// g_ is the gradient here; what touches, before and after, is in contacts_.
bool ContactSides::step(CellState* state, Points* x) {
  if (factored_ != unknowns_) {
    assemble(*state);
    factored_.clear();
    if (!matrix_.factor()) return false;
    factored_ = unknowns_;
  }
  v_.clear();
  for (const int c : cells_) v_.push_back(balance_.volumeError(*state, c));
  const double first = matrix_.solve(g_, v_, &y_, &p_);

  // The pressures go all the way, the others until the energy along their way no longer falls.
  for (std::size_t c = 0; c < cells_.size(); ++c) state->pressures[cells_[c]] += p_[c];
  trial_ = *state;
  const auto go = [&](double t) {
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      const int u = unknowns_[i];
      if (u < num_sides_) {
        trial_.sides[u] = state->sides[u] + t * y_[i];
      } else {
        trial_.turns[u - num_sides_] = state->turns[u - num_sides_] + t * y_[i];
      }
    }
  };
  findWay();
  double t = contact_.maxStep(*x, d_);
  for (int k = 0;; ++k) {
    go(t);
    x_ = *x + t * d_;
    contact_.collect(x_, &contacts_);
    if (k == kMaxSideSearches) break;
    const double now = slope(trial_);
    if (!(now > kSteep * std::abs(first))) break;
    t *= first < 0.0 ? std::clamp(first / (first - now), 0.1, 0.9) : 0.5;
  }
  x->swap(x_);
  state->sides = trial_.sides;
  state->turns = trial_.turns;
  return true;
}

bool ContactSides::solve(double tolerance, CellState* state, Points* x, CellControl* control,
                         Eigen::VectorXd* moved) {
  control->reset(balance_);
  *moved = -state->sides;
  bool touches = false;
  double before = 0.0;
  contact_.collect(*x, &contacts_);
  for (int k = 0; k <= kMaxSteps; ++k) {
    if (!gather()) break;
    touches = true;
    const double left = unbalanced(*state);
    if (left <= kPart * tolerance || !(left < 1e30) || k == kMaxSteps) break;
    if (k > 0 && left > kHelp * before) factored_.clear();
    before = left;
    if (!step(state, x)) break;
  }
  for (int k = 0; k < num_touched_; ++k) {
    const int u = unknowns_[index(k)];
    if (u < num_sides_) {
      control->sides[index(u)] = true;
    } else {
      control->turns[index(u - num_sides_)] = true;
    }
  }
  *moved += state->sides;
  return touches;
}

}  // namespace palpate::tissue
