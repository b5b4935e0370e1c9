// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/contact/contact_potential.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// The tools' way through one cycle: which of them can touch, where they are at part s in [0, 1] of
/// it, and the tissue samples that may meet them.
class ToolSweep {
 public:
  /// `size`: of the tissue at rest [m]. `skip_far`: leave out bodies that cannot touch.
  ToolSweep(contact::ContactPotential* contact, double size, bool skip_far = true)
      : contact_(*contact), size_(size), skip_far_(skip_far) {}

  /// Begins a cycle with the tissue at x, 3 x n [m], of which no node goes farther than about
  /// `way` [m] if nothing pushes it. Returns how many bodies cannot touch.
  int begin(const std::vector<ToolBody>& bodies, const Points& x, double way);
  /// Finds the candidates for contact at x, for the whole way, and sees that they hold while no
  /// node moves farther than a margin.
  void search(const Points& x);
  bool candidatesHold(const Points& x) const {
    return near_.empty() ||
           (x - searched_at_).colwise().squaredNorm().maxCoeff() <= margin_ * margin_;
  }
  /// Brings the bodies to part s of their way.
  void place(double s);
  /// The part, after s and up to `end`, to which the tissue at x can follow in one solve.
  double next(const Points& x, double s, double end);
  /// The longest way of a body in this cycle, over its inscribed radius or `size` [m], whichever is
  /// less.
  double leap(double size) const;
  /// The least inscribed radius of the bodies that can touch [m]; infinity if there is none.
  double thinnest() const;
  /// The `body`-th body of the contact potential, where it is now.
  const contact::RigidBody& placed(int body) const { return placed_[body]; }
  int numBodies() const { return static_cast<int>(near_.size()); }
  /// Instrument of the `body`-th body of the contact potential.
  int instrument(int body) const { return near_[body].instrument; }

 private:
  contact::ContactPotential& contact_;
  double size_;
  bool skip_far_;
  double margin_ = 0.0;  // [m]
  std::vector<ToolBody> near_;
  std::vector<contact::RigidBody> placed_;
  std::vector<double> reach_, allowed_;  // of each near body [m]
  Points searched_at_;
};

}  // namespace palpate::tissue
