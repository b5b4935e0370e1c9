// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/contact/contact_potential.h"
#include "palpate/contact/needle_channel.h"
#include "palpate/contact/obstacle.h"

namespace palpate::tissue {

/// Inserted needles of a body, and the energy of the tissue along their shafts.
class Needles final : public fem::EnergyTerm {
 public:
  /// `X`: rest positions, 3 x n [m]; `tets`: corners, 4 x m; `stiffness`: contact stiffness [Pa/m].
  Needles(const Points& X, const Eigen::Matrix4Xi& tets, double stiffness)
      : X_(X), tets_(tets), stiffness_(stiffness) {}

  /// A cycle begins with the tissue at x, 3 x n [m], and these obstacles.
  void begin(const std::vector<contact::Obstacle>& obstacles, const Points& x);
  /// Obstacle::number of inserted needles, ascending; these have no surface contact.
  const std::vector<int>& inside() const { return inside_; }
  /// Moves the needles to fraction s of the tool path.
  void moveTo(double s);
  void endStep(const Points& x);
  /// At a cycle's end: inserts needles whose axial force exceeds the puncture force. `obstacles`:
  /// in the order of Touch::obstacle.
  void puncture(const std::vector<contact::Obstacle>& obstacles,
                const std::vector<contact::Contact>& contacts, const Points& x);

  /// Calls visit(owner, pull) for all points on needles at the end of the last step.
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
  /// Takes over the needles of `old`, of the same body before a mesh adaptation.
  void goOnFrom(const Needles& old);
  void save(StateWriter* to) const;
  void restore(StateReader* from);

 private:
  struct Inserted {
    int number;
    double end;  // sign of the shape's z axis towards the tip: 1 or -1
    contact::NeedleSettings settings;
    double length, radius;
    contact::NeedleChannel channel;
    contact::Obstacle now;  // of this cycle
    bool there;             // whether present in this cycle
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
