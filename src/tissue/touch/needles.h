// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/contact/contact_potential.h"
#include "palpate/contact/needle_channel.h"
#include "palpate/contact/obstacle.h"

namespace palpate::tissue {

/// The needles in a body: which have punctured it, and what it does to them from then on.
class Needles final : public fem::EnergyTerm {
 public:
  /// `X`: at rest, 3 x n [m]; `tets`: corners, 4 x m; `stiffness`: of contact [Pa/m].
  Needles(const Points& X, const Eigen::Matrix4Xi& tets, double stiffness)
      : X_(X), tets_(tets), stiffness_(stiffness) {}

  /// A cycle begins with the tissue at x, 3 x n [m], and these obstacles on their ways.
  void begin(const std::vector<contact::Obstacle>& obstacles, const Points& x);
  /// Obstacle::number of those that are inside, ascending: their surface is not touched.
  const std::vector<int>& inside() const { return inside_; }
  /// Brings them to part s of their ways.
  void moveTo(double s);
  void endStep(const Points& x);
  /// Where a cycle has ended: needles that press harder than the surface can bear are inside from
  /// now on. `obstacles`: as contacts number them.
  void puncture(const std::vector<contact::Obstacle>& obstacles,
                const std::vector<contact::Contact>& contacts, const Points& x);

  /// visit(owner, pull) of all points where the last step ended.
  template <class Visit>
  void forPulls(const Visit& visit) const {
    for (const Inserted& needle : needles_) {
      for (const contact::NeedleChannel::Pull& pull : needle.channel.pulls()) {
        visit(needle.now.owner, pull);
      }
    }
  }

  double value(const Points& x) const override;
  double addGradient(const Points& x, Points* g) const override;
  void addHessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const override;

  void forget();
  /// Takes over those of `old`, of the same body on another mesh.
  void goOnFrom(const Needles& old);
  void save(StateWriter* to) const;
  void restore(StateReader* from);

 private:
  struct Inserted {
    int number;
    double end;  // of the shape's z axis is the tip: 1 or -1
    contact::NeedleSettings settings;
    double length, radius;
    contact::NeedleChannel channel;
    contact::Obstacle now;  // in this cycle
    bool there;             // in this cycle, too
  };
  static contact::NeedleChannel channelOf(const contact::NeedleSettings& settings, double length,
                                          double radius, double stiffness);
  static void put(double s, Inserted* needle);
  bool find(const Points& x, const Vec3& p, contact::NeedleChannel::MaterialPoint* place) const;

  Points X_;
  Eigen::Matrix4Xi tets_;
  double stiffness_;
  std::vector<Inserted> needles_;
  std::vector<int> inside_;
};

}  // namespace palpate::tissue
