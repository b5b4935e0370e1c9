// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/fem/cavity.h"
#include "palpate/fem/foundation.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/tissue/surroundings.h"

namespace palpate::tissue {

/// Boundary conditions of a finite element body: energy terms and prescribed motion. Has the
/// simulated time, which begins at zero [s].
class BodySurroundings {
 public:
  BodySurroundings(const Surroundings& surroundings, const mesh::TetMesh& mesh);

  /// Energy terms; valid while this exists.
  std::vector<const fem::EnergyTerm*> terms() const;
  bool empty() const { return springs_.empty() && cavities_.empty(); }
  /// Whether nodes have prescribed motion.
  bool carries() const { return !carried_.empty(); }
  bool damps() const { return damps_; }
  bool resistsVolumes() const { return resists_volumes_; }
  bool presses() const { return !cavities_.empty(); }
  /// Whether a load acts in the rest configuration.
  bool actsAtRest() const;
  /// Whether a boundary condition depends on time.
  bool moves() const { return moves_; }

  /// Scales all rest pressures by `factor` [-].
  void setFactor(double factor);
  /// Sets the cavities' reference volumes to those at x, 3 x n [m].
  void seal(const Points& x);
  /// Largest pressure in a cavity at x, or zero [Pa].
  double largestPressure(const Points& x) const;

  /// Begins a cycle of `dt` [s]; endCycle() advances the time.
  void beginCycle(double dt) { cycle_ = dt; }
  void endCycle() {
    if (moves_) time_ += cycle_;
  }
  /// Moves spring anchors to fraction `s` in [0, 1] of the cycle.
  void moveTo(double s);
  /// Begins a step of `h` [s] at x, 3 x n [m]; infinite h: no damping.
  void beginStep(double h, const Points& x);
  /// Displacement from x to the prescribed positions at fraction `s`, 3 x n [m]; zero for other
  /// nodes.
  void carry(double s, const Points& x, Points* way) const;
  /// Sets prescribed nodes to their positions at fraction `s`; `first`: column of node 0 in x.
  void carryTo(double s, Points* x, int first) const;
  /// Common displacement of all supports at fraction `s` of the cycle [m]; zero unless all move
  /// alike.
  Vec3 commonWay(double s) const;
  /// Moves springs to the cycle's end, without damping.
  void rest();
  /// Resets the time to zero.
  void reset();

  /// `free` with ones for prescribed nodes: components with velocity.
  fem::FreeMask movable(fem::FreeMask free) const;
  std::vector<fem::HeldDirection> heldDirections() const;
  /// Upper bound of the squared frequencies that springs add to a body at rest in X, 3 x n [m],
  /// with `masses`, n [kg] [1/s^2].
  double largestSquare(const Points& X, const Eigen::VectorXd& masses) const;

  void goOnFrom(const BodySurroundings& old);
  /// Writes the state; empty where time does not matter.
  void save(StateWriter* out) const;
  void restore(StateReader* in);

 private:
  struct Carried {
    std::vector<int> nodes;
    Points rest;
    Motion motion;
  };
  struct Springs {
    fem::Foundation foundation;
    std::optional<Motion> motion;
  };
  double at(double s) const { return time_ + s * cycle_; }

  std::vector<Carried> carried_;
  std::vector<Springs> springs_;
  std::vector<fem::CavityPressure> cavities_;
  bool moves_, damps_, resists_volumes_, holds_still_;
  double time_ = 0.0, cycle_ = 0.0;  // [s]
};

}  // namespace palpate::tissue
