// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "fem_body.h"

namespace palpate::tissue {

/// Contact as prescribed displacement [Castillo Leon 2011, sec. 7.5, for a segment as tool]: a
/// surface point that is inside a tool is put on the tool's surface along the normal and held
/// there. A node moves alone; a point amid an edge or triangle moves its two or three nodes alike,
/// if none of them is held. What holds pulls is let go.
class PrescribedContact {
 public:
  explicit PrescribedContact(FemBody* body) : body_(*body), held_(body->free) {}

  void clear();
  /// The holds of `earlier`, of the same body.
  void restore(const PrescribedContact& earlier);
  /// All that it remembers.
  void save(StateWriter* to) const;
  /// @throws std::invalid_argument for bytes of another body.
  void restore(StateReader* from);
  /// Finds the tools of earlier holds among those placed now; holds by others are let go.
  void beginStage();
  /// The way that the holds ask of x, 3 x n [m]; zero where nothing is held.
  void moves(const Points& x, Points* move) const;
  /// Holds the points that are inside a tool at x, 3 x n [m]; false if there was no new one.
  bool holdWhatPenetrates(const Points& x);
  /// Lets go what the tools pull at, given the gradient of all energies at x, 3 x n [N]; false if
  /// there was nothing.
  bool release(const Points& x, const Points& gradient);

  /// 1 where neither the supports nor a tool hold a component, else 0; 3 x n.
  const fem::FreeMask& free() const { return held_; }
  /// The forces of the tissue on the tools, given the gradient of all energies at x, 3 x n [N].
  void report(const Points& x, const Points& gradient, TissueStep* out) const;

 private:
  struct Hold {
    int sample;
    int number;         // Obstacle::number
    int obstacle = -1;  // of those placed now
  };
  Vec3 force(const Hold& hold, const Points& gradient) const;
  bool free(int sample) const;
  void hold(const contact::Touch& touch);
  void updateMask();

  FemBody& body_;
  std::vector<Hold> holds_;
  std::vector<contact::Touch> touches_;
  fem::FreeMask held_;
};

}  // namespace palpate::tissue
