// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "palpate/contact/response.h"
#include "palpate/contact/surface_samples.h"
#include "palpate/fem/energy_term.h"

namespace palpate::contact {

class FacePoints;
class SampleRuns;
struct SamplePart;
struct SampleCandidate;

/// An active touch with its force.
struct Contact {
  Contact(const Touch& t, const Vec3& f_W) : touch(t), force_W(f_W) {}

  Touch touch;
  Vec3 force_W;  ///< Force of the tissue on the obstacle, at touch.p_W, world [N].
};

/// Contact of a tissue surface with obstacles: the sum of a Response's energies over all touches.
/// A sample inside two obstacles has two touches. Only candidates are evaluated: samples that were
/// within reach when findCandidates() ran.
class ContactPotential final : public fem::EnergyTerm {
 public:
  ContactPotential(std::vector<SurfaceSample> samples, std::unique_ptr<Response> response);
  ~ContactPotential() override;

  /// Adds contact of triangles with balls of thin or sharp instruments, which samples miss:
  /// FacePoints. `X`: points at rest, 3 x n [m]; `triangles`: the surface, outward; `spacing`: of
  /// the samples, as for sampleSurface().
  void addFaceContact(const Points& X, const Eigen::Matrix3Xi& triangles, double spacing);

  /// Adds samples for the anatomy alone, by sampleSurface() with `spacing` [m]; coarser than those
  /// for tools. @pre Called once.
  void addAnatomySamples(const Points& X, const Eigen::Matrix3Xi& triangles, double spacing);

  /// Sets the thickness of a sheet [m]; samples lie in the middle of it, and both sides touch.
  /// @pre Before the first setObstacles().
  void setThickness(double thickness) { margin_ = 0.5 * thickness; }

  /// All samples; those for the anatomy come last.
  const std::vector<SurfaceSample>& samples() const { return samples_; }
  /// Number of samples for instruments, the first of samples().
  int numForInstruments() const { return for_anatomy_ ? for_anatomy_->sample : numSamples(); }
  /// Largest distance of a sample from an obstacle at which a touch has energy [m].
  double reach() const { return response_->reach() + margin_ + largest_offset_; }

  /// Sets SurfaceSample::offset of all samples, 3 x numSamples [m].
  void setOffsets(const Points& offsets);

  /// Sets the obstacles' poses; a step begins at X_WG_begin and ends at X_WG_end.
  /// @pre Number and order are those of the last findCandidates(), or findCandidates() follows.
  void setObstacles(const std::vector<Obstacle>& obstacles);

  /// Makes candidates of all samples nearer to obstacle b than `reach[b]` [m] at x, 3 x n [m].
  void findCandidates(const Points& x, const std::vector<double>& reach);
  bool hasCandidates() const { return numCandidates() > 0; }
  /// Whether one of the posed obstacles has candidates.
  bool hasCandidates(int obstacle) const;
  int numObstacles() const { return static_cast<int>(posed_.size()); }
  int numCandidates() const;
  /// Pairs of sample and obstacle that the last findCandidates() left out.
  int numDistant() const;

  /// Sets properties of the nodes: `free`, 3 x n (fem::FreeMask), `masses`, n [kg], and
  /// `stiffness`, n, Young's modulus over the edge length [Pa/m]. Response::learn() skips samples
  /// that cannot move.
  void setBearing(const Eigen::Matrix3Xd& free, const Eigen::VectorXd& masses,
                  const Eigen::VectorXd& stiffness);

  /// Switches skipping of distant samples and of derivatives of inactive ones; on by default.
  /// The sums do not depend on it.
  void setSkips(bool distant, bool inactive);
  /// Nodes of the candidates' triangles, ascending.
  void candidateNodes(std::vector<int>* nodes) const;

  /// push += first-order change of the nodal contact forces at fixed x while obstacle k moves by
  /// motions[k], 3 x n [N]. Returns false where nothing touches.
  bool addPush(const Points& x, const std::vector<Pose>& motions, Points* push) const;

  double value(const Points& x) const override;
  double addGradient(const Points& x, Points* g) const override;
  void addHessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const override;

  /// Limits a step so that no sample goes more than half-way to an obstacle's middle.
  /// A sample so stays on its side of the obstacle.
  double maxStep(const Points& x, const Points& d) const override;

  /// How far each obstacle, which goes `ways` [m] in a cycle, may move at once [m] until its
  /// nearest candidate at x is as deep as that, or as half an edge of the triangle around it is
  /// long: elements that are pushed farther in one go fold.
  void allowedMotions(const Points& x, const std::vector<double>& ways,
                      std::vector<double>* allowed) const;

  /// Collects all active touches at x, in a fixed order.
  void collect(const Points& x, std::vector<Contact>* contacts) const;
  /// Second derivative of a contact's energy by the sample's position [N/m], and its positive
  /// semidefinite part.
  Mat3 stiffness(const Contact& contact) const {
    return response_->stiffness(contact.touch, fem::Tangent::kExact);
  }
  Mat3 convexStiffness(const Contact& contact, const Mat3& exact) const {
    return response_->convexStiffness(contact.touch, exact, contact.force_W);
  }
  /// Collects all candidates inside an obstacle at x, active or not; without motion_W.
  void penetrating(const Points& x, std::vector<Touch>* touches) const;
  /// The touch of a sample and a posed obstacle at x, without motion_W.
  Touch touch(int sample, int obstacle, const Points& x) const;

  /// A step begins with the tissue at x, 3 x n [m], and the obstacles at X_WG_begin.
  void beginStep(const Points& x);
  /// Whether the solution x of the step needs no further augmentation; else augment() and solve
  /// again.
  bool augmentationConverged(const Points& x);
  void augment(const Points& x);
  /// Updates the response by the solution x of a step of `h` [s], for the next step.
  void learn(const Points& x, double h);
  bool hasFriction() const { return response_->hasFriction(); }
  /// Whether friction is evaluated for a contact.
  bool rubs(const Contact& contact) const { return response_->rubs(contact.touch); }
  /// The step has ended at x.
  void endStep(const Points& x);
  /// Collects the contacts at the end of the last step, as they were before endStep().
  void collectAtEnd(const Points& x, std::vector<Contact>* contacts) const;
  /// Clears the state: nothing has touched yet.
  void forget();
  /// Takes over the state of `old`, of the same body with another surface; X and old_X are the rest
  /// positions of both, 3 x n [m]. Samples at new positions begin without state.
  void goOnFrom(const ContactPotential& old, const Points& X, const Points& old_X);
  /// Writes and reads the state between steps; empty where the response has none.
  void save(StateWriter* to) const;
  void restore(StateReader* from);

 private:
  struct Patch {  // samples of one triangle, which follow one another
    Eigen::Vector3i nodes;
    int begin, end;
    int triangle;               // of the surface; known where faces are met
    int first_part, last_part;  // of parts_, [first, last)
  };
  struct First {  // where those for the anatomy begin
    int patch, sample;
  };
  int numSamples() const { return static_cast<int>(samples_.size()); }
  int numPatches() const { return static_cast<int>(patches_.size()); }
  void addPatches(int first_sample);
  std::pair<int, int> patchesFor(const PosedObstacle& posed) const;
  bool isForAnatomy(int sample) const { return sample >= numForInstruments(); }
  template <class Far, class Visit>
  void forCandidates(const Points& x, const Far& far, const Visit& visit) const;
  void gather(const Points& x);
  bool addSamples(const Points& x, int obstacle, double reach);
  template <class Visit>
  void forSamples(const Points& x, bool skip_inactive, bool with_frame, const Visit& visit) const;
  template <class Visit>
  void forFaces(const Points& x, const Visit& visit) const;
  double mobilityOf(const Touch& touch) const;
  double bearingOf(const Touch& touch) const;
  static std::vector<Response::SurfaceMap::Node> placesOf(const std::vector<int>& nodes,
                                                          const Points& X,
                                                          const ContactPotential& old,
                                                          const Points& old_X);
  void gatherLearnable(const Points& x, double h);
  template <class Visit>
  void forEach(const Points& x, bool skip_inactive, bool with_frame, const Visit& visit) const;

  std::vector<SurfaceSample> samples_;
  std::vector<Patch> patches_;
  std::vector<SamplePart> parts_;
  std::optional<First> for_anatomy_;  // none: it meets what instruments meet
  std::unique_ptr<FacePoints> faces_;
  bool nodes_only_ = false;  // are samples
  std::unique_ptr<Response> response_;
  double margin_ = 0.0;      // see setThickness() [m]
  Eigen::VectorXd masses_;   // of the nodes, infinite where held [kg]; empty: they weigh nothing
  Eigen::VectorXd bearing_;  // see setBearing(); empty: nothing is known of it
  double largest_offset_ = 0.0;  // of a sample [m]
  bool skip_distant_ = true, skip_inactive_ = true;
  std::vector<PosedObstacle> posed_;
  std::vector<SampleCandidate> candidates_;
  std::unique_ptr<SampleRuns> runs_;  // of the candidates
  Points x_begin_;               // of the step, where the response follows motions or remembers;
  bool begun_ = false;           // since it forgot
  std::vector<Contact> at_end_;  // of the last step, where the response remembers
  std::vector<Touch> touches_;
};

}  // namespace palpate::contact
