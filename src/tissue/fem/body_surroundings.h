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

/// What its surroundings do to a body of finite elements: terms of its energy, and ways that held
/// nodes are carried. Knows the simulated time, which begins at zero.
class BodySurroundings {
 public:
  BodySurroundings(const Surroundings& surroundings, const mesh::TetMesh& mesh);

  /// What acts on the body; lives as long as this.
  std::vector<const fem::EnergyTerm*> terms() const;
  bool empty() const { return springs_.empty() && cavities_.empty(); }
  /// Whether held nodes are carried.
  bool carries() const { return !carried_.empty(); }
  bool damps() const { return damps_; }
  bool resistsVolumes() const { return resists_volumes_; }
  bool presses() const { return !cavities_.empty(); }
  /// Whether something would move the body at rest.
  bool actsAtRest() const;
  /// Whether anything depends on time.
  bool moves() const { return moves_; }

  /// All pressures of rest times `factor`.
  void setFactor(double factor);
  /// Cavities are full of their content where the body is at x, 3 x n [m].
  void seal(const Points& x);
  /// The largest pressure in a cavity, or zero [Pa].
  double largestPressure(const Points& x) const;

  /// The next cycle, of `dt` [s]; endCycle() lets its time pass.
  void beginCycle(double dt) { cycle_ = dt; }
  void endCycle() {
    if (moves_) time_ += cycle_;
  }
  /// Anchors are where they are at part `s` in [0, 1] of the cycle.
  void moveTo(double s);
  /// A step of `h` [s], infinity: without damping, begins at x, 3 x n [m].
  void beginStep(double h, const Points& x);
  /// From x to where the carried nodes are at part `s`, 3 x n [m], zero of others.
  void carry(double s, const Points& x, Points* way) const;
  /// Puts the carried nodes of x there.
  void carryTo(double s, Points* x) const;
  /// How far all that holds the body has moved by part `s` of the cycle [m]; zero where it does not
  /// move alike, or a component is held that does not move.
  Vec3 commonWay(double s) const;
  /// Springs are where they are at the end of the cycle, as if nothing moved.
  void rest();
  /// Back to time zero.
  void reset();

  /// `free` with ones for carried nodes: where there may be a velocity.
  fem::FreeMask movable(fem::FreeMask free) const;
  std::vector<fem::HeldDirection> heldDirections() const;
  /// Bound of the square of the frequencies that it adds to a body at rest in X of these masses,
  /// n [1/s^2].
  double largestSquare(const Points& X, const Eigen::VectorXd& masses) const;

  void goOnFrom(const BodySurroundings& old);
  /// Nothing where nothing is remembered.
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
