// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/contact/needle.h"
#include "palpate/fem/energy_term.h"

namespace palpate::contact {

/// A needle in a body: points of the tissue along its axis, which do not leave it sideways and
/// stick to it along the axis until they are pulled with more than the friction, or, at the tip,
/// the cutting force. Of a point at the distance d from the axis and at the place z along it, with
/// w = z0 - z and the place z0 where it sticks,
///
///   E = k d^2 / 2 + h(w),  h(w) = k w^2 / 2 while -lower <= k w <= upper, and linear beyond,
///
/// so that slip needs no step of its own; z0 follows when a step has ended.
class NeedleChannel final : public fem::EnergyTerm {
 public:
  /// A point of the tissue: where it is in a tetrahedron.
  struct MaterialPoint {
    Eigen::Vector4i nodes;
    Eigen::Vector4d weights;
    Vec3 of(const Points& x) const { return x(Eigen::all, nodes) * weights; }
  };
  struct Anchor {
    MaterialPoint place;
    Vec3 X;              // at rest, by which it is found in another mesh [m]
    double at;           // z0 [m]
    double share = 0.0;  // of the shaft, from there to the next [m]
  };

  /// `length` [m]: from the shape's origin to its tip; `stiffness`: k [N/m]; `spacing`: of the
  /// points [m].
  NeedleChannel(const NeedleSettings& settings, double length, double stiffness, double spacing)
      : settings_(settings), length_(length), stiffness_(stiffness), spacing_(spacing) {}

  /// Where the needle is: the shape's origin and the axis towards its tip, unit, in world.
  void setPose(const Vec3& origin, const Vec3& axis);
  bool empty() const { return anchors_.empty(); }
  Vec3 tip() const { return origin_ + length_ * axis_; }
  /// Adds the tissue at the tip as a point, which is met with `force` [N].
  void addTip(const MaterialPoint& place, const Vec3& X, double force);
  /// Whether the tip has gone on so far from its point that it needs the next.
  bool wantsTip(const Points& x) const;
  /// What the tissue at the tip resists now [N].
  double tipForce(const Points& x) const;

  double value(const Points& x) const override;
  double addGradient(const Points& x, Points* g) const override;
  void addHessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const override;

  /// A step has ended at x: points that slipped stick where they are, those that the tip has been
  /// drawn back from are free.
  void endStep(const Points& x);

  /// What a point did to the needle where the last step ended, before that became memory.
  struct Pull {
    MaterialPoint place;
    Vec3 p_W, force_W;  ///< [m], [N]
  };
  const std::vector<Pull>& pulls() const { return pulls_; }
  /// Finds the points in another mesh: find(X, &place), false where there is no tissue.
  template <class Find>
  void relocate(const Find& find) {
    for (std::size_t k = 0; k < anchors_.size();) {
      if (find(anchors_[k].X, &anchors_[k].place)) {
        ++k;
      } else {
        remove(k);
      }
    }
  }

  void save(StateWriter* to) const;
  /// Of a body of `points`.
  void restore(StateReader* from, Eigen::Index points);

 private:
  // How far a point may be pulled along the axis [N], against and along the way to the tip.
  struct Limits {
    double lower, upper;
  };
  Limits limits(std::size_t k) const;
  bool isTip(std::size_t k) const { return has_tip_ && k + 1 == anchors_.size(); }
  double along(std::size_t k, const Vec3& p) const {
    return anchors_[k].at - axis_.dot(p - origin_);
  }
  void remove(std::size_t k);
  // Of the energy by the point.
  Vec3 gradient(std::size_t k, const Vec3& p) const;

  NeedleSettings settings_;
  double length_, stiffness_, spacing_;
  Vec3 origin_ = Vec3::Zero(), axis_ = Vec3::UnitZ();
  std::vector<Anchor> anchors_;  // from where it went in to the tip
  bool has_tip_ = false;         // the last is at the tip
  std::vector<Pull> pulls_;
};

}  // namespace palpate::contact
