// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/contact/contact_potential.h"

namespace palpate::tissue {

/// The obstacles' way through one cycle: which of them can touch, where they are at part s in [0,
/// 1] of it, and the tissue samples that may meet them.
class ToolPath {
 public:
  /// `size`: of the tissue at rest [m]. `skip_far`: leave out obstacles that cannot touch.
  ToolPath(contact::ContactPotential* contact, double size, bool skip_far = true)
      : contact_(*contact), size_(size), skip_far_(skip_far) {}

  /// Begins a cycle with the tissue at x, 3 x n [m], of which no node goes farther than about
  /// `way` [m] if nothing pushes it. Returns how many obstacles cannot touch.
  int begin(const std::vector<contact::Obstacle>& obstacles, const Points& x, double way);
  /// There are no obstacles, until the next cycle begins.
  void clear();
  /// Those that can touch, on their way through the cycle.
  const std::vector<contact::Obstacle>& near() const { return near_; }
  /// The obstacles with these numbers, ascending, do not touch in this cycle.
  void leaveOut(const std::vector<int>& numbers);
  /// Finds the candidates for contact at x, for the whole way, and sees that they hold while no
  /// node moves farther than a margin, which each further search in a cycle makes wider.
  void search(const Points& x);
  bool candidatesHold(const Points& x) const {
    return near_.empty() ||
           (x - searched_at_).colwise().squaredNorm().maxCoeff() <= margin_ * margin_;
  }
  /// Brings the obstacles to part s of their way.
  void moveTo(double s);
  /// The forces on the nodes, 3 x n [N], that touches at x gain, to first order, while the
  /// obstacles go from where they are to part s of their way and x stays. False: there are none.
  bool pushTo(double s, const Points& x, Points* push);
  /// A step, or the first one of the cycle, begins with the tissue at x and the obstacles where
  /// they are.
  void beginStep(const Points& x);
  /// The part, after s and up to `end`, to which the tissue at x can follow in one solve.
  double next(const Points& x, double s, double end);
  /// The longest way of an obstacle in this cycle, over its inscribed radius or `size` [m],
  /// whichever is less.
  double leap(double size) const;
  /// The longest way in this cycle of an obstacle that can touch [m].
  double longestWay() const;
  /// The least inscribed radius of the obstacles that can touch [m]; infinity if there is none.
  double thinnest() const;
  /// Who owns an obstacle of the contact potential.
  const contact::Owner& owner(int obstacle) const { return near_[obstacle].owner; }
  /// The obstacle of the contact potential that has this number in the cycle, or -1.
  int find(int number) const;

 private:
  contact::ContactPotential& contact_;
  double size_;
  bool skip_far_;
  double margin_ = 0.0;                         // [m]
  bool searched_ = false;                       // in this cycle
  std::vector<contact::Obstacle> near_;         // on their way through the cycle
  std::vector<contact::Obstacle> placed_;       // from where the step began to where they are
  std::vector<double> ways_, reach_, allowed_;  // of each near one [m]
  std::vector<Pose> motions_;                   // likewise
  Points searched_at_;
};

}  // namespace palpate::tissue
