// SPDX-License-Identifier: GPL-3.0-or-later
#include "cell_solver.h"

#include <algorithm>
#include <cmath>

namespace palpate::tissue {

CellSolver::CellSolver(const CellBalance& balance, const CornerMap& map,
                       const contact::ContactPotential& contact, const HoneycombSettings& settings,
                       double tolerance)
    : balance_(balance),
      map_(map),
      contact_(contact),
      settings_(settings),
      tolerance_(tolerance),
      waves_(balance, settings.waves == "outward", settings.cut_off),
      contact_sides_(balance, map, contact),
      mixing_(balance.lattice().numSides() + 4 * balance.lattice().numCells(), settings.mixing),
      turn_scale_(0.5 * balance.lattice().size.minCoeff()) {
  const CellLattice& lattice = balance.lattice();
  double stiffest = 0.0;
  for (const Vec3& k : balance.fabric().stretch) stiffest = std::max(stiffest, k.maxCoeff());
  pressure_scale_ = lattice.volume() / lattice.size.maxCoeff() / stiffest;
  control_.reset(balance);
  begin_.resize(lattice.numSides() + 4 * lattice.numCells());
  middle_ = end_ = trial_ = begin_;
  moved_.resize(lattice.numSides());
  sides_.resize(lattice.numSides());
  turns_.resize(3 * lattice.numCells());
  x_ = map.rest();
}

void CellSolver::pack(const CellState& state, Eigen::VectorXd* x) const {
  const Eigen::Index s = state.sides.size(), c = state.pressures.size();
  x->head(s) = state.sides;
  x->segment(s, c) = pressure_scale_ * state.pressures;
  x->tail(3 * c) = turn_scale_ * state.turns;
}

void CellSolver::unpack(const Eigen::VectorXd& x, CellState* state) const {
  const Eigen::Index s = state->sides.size(), c = state->pressures.size();
  state->sides = x.head(s);
  state->pressures = x.segment(s, c) / pressure_scale_;
  state->turns = x.tail(3 * c) / turn_scale_;
}

void CellSolver::contactForces(const Points& x, Points* f) const {
  f->setZero(3, x.cols());
  contact_.addGradient(x, f);
  *f = -*f;
}

bool CellSolver::counts(int side) const {
  const auto& cells = balance_.lattice().sides[static_cast<std::size_t>(side)].cells;
  return (cells[0] >= 0 && waves_.reached(cells[0])) || (cells[1] >= 0 && waves_.reached(cells[1]));
}

double CellSolver::unbalanced(const CellState& state, bool everywhere, double* volume_error) {
  map_.placeSurface(state, &x_);
  return unbalancedHere(state, everywhere, volume_error);
}

// x_ are its corners.
double CellSolver::unbalancedHere(const CellState& state, bool everywhere, double* volume_error) {
  contactForces(x_, &f_);
  sides_.setZero();
  turns_.setZero();
  map_.pull(f_, &sides_, &turns_);
  double square = 0.0;
  for (int s = 0; s < balance_.lattice().numSides(); ++s) {
    if (balance_.held().along_normal[static_cast<std::size_t>(s)]) continue;
    if (!everywhere && !counts(s)) continue;
    const double force = balance_.force(state, s) + sides_[s];
    square += force * force;
  }
  *volume_error = 0.0;
  for (int c = 0; c < balance_.lattice().numCells(); ++c) {
    if (!everywhere && !waves_.reached(c)) continue;
    *volume_error = std::max(
        *volume_error, std::abs(balance_.volumeError(state, c)) / balance_.lattice().volume());
    for (int turn = 3 * c; turn < 3 * c + 3; ++turn) {
      const double force = (balance_.torque(state, turn) + turns_[turn]) / turn_scale_;
      square += force * force;
    }
  }
  return std::sqrt(square);
}

// No sample may get to the other side of a tool on the way from `from`, of which x_ are the
// corners, to the state: it goes part of that way. True: it may go all the way. x_ follows.
bool CellSolver::stayOutside(const Eigen::VectorXd& from, CellState* state) {
  next_ = x_;
  map_.placeSurface(*state, &next_);
  f_ = next_ - x_;
  const double part = contact_.hasCandidates() ? contact_.maxStep(x_, f_) : 1.0;
  if (part >= 1.0) {
    x_.swap(next_);
    return true;
  }
  pack(*state, &trial_);
  trial_ = from + part * (trial_ - from);
  unpack(trial_, state);
  x_ += part * f_;
  return false;
}

CellSolve CellSolver::solve(int max_waves, const solver::Interrupt* interrupt, CellState* state,
                            bool whole) {
  CellSolve report;
  const double volume_tolerance = settings_.threshold / balance_.lattice().size.maxCoeff();
  report.residual = unbalanced(*state, true, &report.volume_error);
  const auto converged = [&] {
    return report.residual <= tolerance_ && report.volume_error <= volume_tolerance;
  };
  if (converged()) {
    report.status = solver::SolveStatus::kConverged;
    return report;
  }
  mixing_.forget();
  contact_sides_.forget();
  waves_.begin(whole);
  fronts_of_.clear();
  while (report.waves < max_waves) {
    if (solver::isInterrupted(interrupt)) {
      report.status = solver::SolveStatus::kDeadline;
      return report;
    }
    pack(*state, &begin_);
    contact_sides_.solve(std::max(tolerance_, report.residual), state, &x_, &control_, &moved_);
    if (fronts_of_ != control_.sides || turns_of_ != control_.turns) {
      waves_.findFronts(control_);
      fronts_of_ = control_.sides;
      turns_of_ = control_.turns;
      mixing_.forget();
    }
    pack(*state, &middle_);
    const int solved = waves_.run(control_, moved_, state);
    if (solved != solved_) mixing_.forget();  // others take part
    solved_ = solved;
    report.cells += solved;
    stayOutside(middle_, state);
    ++report.waves;
    report.residual = unbalancedHere(*state, false, &report.volume_error);
    pack(*state, &end_);
    if (!end_.allFinite()) {
      report.status = solver::SolveStatus::kNonFinite;
      return report;
    }
    const Eigen::Index sides = state->sides.size();
    const double change = (end_ - begin_).head(sides).cwiseAbs().maxCoeff();
    if (change <= settings_.threshold && converged()) {
      report.status = solver::SolveStatus::kConverged;
      return report;
    }
    middle_ = end_;
    mixing_.mix(begin_, &end_);
    unpack(end_, state);
    if (!stayOutside(middle_, state)) mixing_.forget();
  }
  report.residual = unbalancedHere(*state, false, &report.volume_error);
  return report;
}

}  // namespace palpate::tissue
