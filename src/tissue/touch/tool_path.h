// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/contact/contact_potential.h"

namespace palpate::tissue {

/// Motion of the obstacles in a cycle by the fraction s in [0, 1]: near obstacles, their poses, and
/// the candidates of contact.
class ToolPath {
 public:
  /// `size`: diagonal of the tissue at rest [m]; `skip_far`: skip obstacles that cannot touch.
  ToolPath(contact::ContactPotential* contact, double size, bool skip_far = true)
      : contact_(*contact), size_(size), skip_far_(skip_far) {}

  /// Begins a cycle with the tissue at x, 3 x n [m]; `way`: estimated displacement of a node
  /// without contact [m]. Returns the number of obstacles that cannot touch.
  int begin(const std::vector<contact::Obstacle>& obstacles, const Points& x, double way);
  /// Removes all obstacles until the next begin().
  void clear();
  /// Obstacles that can touch, with their poses at begin and end of the cycle.
  const std::vector<contact::Obstacle>& near() const { return near_; }
  /// Excludes the obstacles with these numbers, ascending, from the cycle.
  void leaveOut(const std::vector<int>& numbers);
  /// Finds the candidates at x for the whole path. They hold while no node moves farther than a
  /// margin, which grows with each search in a cycle.
  void search(const Points& x);
  bool candidatesHold(const Points& x) const {
    return near_.empty() ||
           (x - searched_at_).colwise().squaredNorm().maxCoeff() <= margin_ * margin_;
  }
  /// Moves the obstacles to fraction s of the path.
  void moveTo(double s);
  /// First-order change of the nodal contact forces at fixed x, 3 x n [N], while the obstacles move
  /// to fraction s. Returns false where nothing touches.
  bool pushTo(double s, const Points& x, Points* push);
  /// A step begins with the tissue at x and the obstacles at their present poses.
  void beginStep(const Points& x);
  /// End of the next stage: the fraction in (s, end] that the tissue at x can follow in one solve.
  double next(const Points& x, double s, double end);
  /// Largest ratio of an obstacle's displacement in the cycle to the lesser of its inscribed radius
  /// and `size` [m].
  double leap(double size) const;
  /// Largest displacement of a near obstacle in the cycle [m].
  double longestWay() const;
  /// Least inscribed radius of the near obstacles [m]; infinity without any.
  double thinnest() const;
  /// Owner of an obstacle of the contact potential.
  const contact::Owner& owner(int obstacle) const { return near_[obstacle].owner; }
  /// Index in the contact potential of the obstacle with this number, or -1.
  int find(int number) const;

 private:
  contact::ContactPotential& contact_;
  double size_;
  bool skip_far_;
  double margin_ = 0.0;                         // [m]
  bool searched_ = false;                       // in this cycle
  std::vector<contact::Obstacle> near_;         // with the poses of the cycle
  std::vector<contact::Obstacle> placed_;       // with the poses of the step
  std::vector<double> ways_, reach_, allowed_;  // of near_ [m]
  std::vector<Pose> motions_;                   // likewise
  Points searched_at_;
};

}  // namespace palpate::tissue
