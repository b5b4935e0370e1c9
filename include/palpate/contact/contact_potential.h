// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/contact/penalty.h"
#include "palpate/contact/signed_distance.h"
#include "palpate/contact/surface_samples.h"
#include "palpate/fem/energy_term.h"

namespace palpate::contact {

/// A collision shape of an instrument at one instant.
struct RigidBody {
  const instrument::Geometry* geometry;
  Pose X_WG;
  int instrument;  ///< Whose it is.
};

/// A surface sample that is inside a rigid body.
struct Contact {
  int sample;
  int body;            ///< Index into the bodies given to setBodies().
  double penetration;  ///< [m], > 0
  Vec3 p_W;            ///< The sample [m].
  Vec3 force_W;        ///< What the tissue does to the tool, at p_W [N].
  Mat3 stiffness_W;    ///< Derivative of the force by p_W: second derivative of the energy [N/m].
};

/// Penalty energy of a tissue surface against rigid bodies,
///   sum over samples s and bodies b of area_s psi(-d_b(p_s)),
/// with the exact derivative, the curvature of the shapes included. A sample inside two bodies
/// feels both. Only candidates are looked at: samples that were within reach when findCandidates()
/// ran.
class ContactPotential final : public fem::EnergyTerm {
 public:
  ContactPotential(std::vector<SurfaceSample> samples, Penalty penalty);

  const std::vector<SurfaceSample>& samples() const { return samples_; }

  /// Places the bodies. Same number and order as at the last findCandidates(), or call that next.
  void setBodies(const std::vector<RigidBody>& bodies);

  /// Takes as candidates of body b all samples that are less than `reach[b]` [m] from it at x.
  void findCandidates(const Points& x, const std::vector<double>& reach);
  bool hasCandidates() const { return !candidates_.empty(); }
  int numCandidates() const { return static_cast<int>(candidates_.size()); }
  /// Samples, times bodies, that the last findCandidates() did not take.
  int numDistant() const {
    return static_cast<int>(bodies_.size() * samples_.size() - candidates_.size());
  }

  /// What is left out: samples out of reach, derivatives of samples that do not touch. Both by
  /// default; the sums are the same without.
  void setSkips(bool distant, bool inactive) {
    skip_distant_ = distant;
    skip_inactive_ = inactive;
  }
  /// The nodes that candidates lie between, ascending.
  void candidateNodes(std::vector<int>* nodes) const;

  double value(const Points& x) const override;
  double addGradient(const Points& x, Points* g) const override;
  /// The projected form leaves out the shapes' curvature, the only part that is not semidefinite.
  void addHessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const override;

  /// No sample may go deeper into a body than half of what is left to its
  /// middle, so that it stays on the side from
  /// which it came.
  double maxStep(const Points& x, const Points& d) const override;

  /// How far each body may move at once [m] until its nearest candidate at x is as deep
  /// as that.
  void allowedMotions(const Points& x, std::vector<double>* allowed) const;

  /// All candidates inside a body at x, in a fixed order.
  void collect(const Points& x, std::vector<Contact>* contacts) const;

 private:
  struct Candidate {
    int sample, body;
  };
  struct Patch {  // samples of one triangle, which follow one another
    Eigen::Vector3i nodes;
    int begin, end;
  };
  double radius(const Candidate& c) const { return radius_[c.body]; }
  template <class Visit>
  void forEachPenetrating(const Points& x, const Visit& visit) const;

  std::vector<SurfaceSample> samples_;
  std::vector<Patch> patches_;
  Penalty penalty_;
  bool skip_distant_ = true, skip_inactive_ = true;
  std::vector<RigidBody> bodies_;
  std::vector<double> radius_;  // inscribed, of each body [m]
  std::vector<Candidate> candidates_;
};

}  // namespace palpate::contact
