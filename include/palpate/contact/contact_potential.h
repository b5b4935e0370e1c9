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

/// A touch that is answered.
struct Contact {
  Contact(const Touch& t, const Vec3& f_W) : touch(t), force_W(f_W) {}

  Touch touch;
  Vec3 force_W;  ///< What the tissue does to the obstacle, at touch.p_W [N].
};

/// Contact of a tissue surface with obstacles: the energies of all touches of samples s and
/// obstacles b, of which a Response says what they are. A sample inside two obstacles feels both.
/// Only candidates are looked at: samples that were within reach when findCandidates() ran.
class ContactPotential final : public fem::EnergyTerm {
 public:
  ContactPotential(std::vector<SurfaceSample> samples, std::unique_ptr<Response> response);
  ~ContactPotential() override;

  /// Has instruments that are thinner than samples are apart, or have corners and edges, meet the
  /// surface's triangles, too: see FacePoints. `X`: points at rest, 3 x n [m]; `triangles`: the
  /// surface, outward; `spacing`: of the samples, as for sampleSurface().
  void addFaceContact(const Points& X, const Eigen::Matrix3Xi& triangles, double spacing);

  /// Has parts of the anatomy meet samples of their own, sampleSurface()'s of that `spacing`, and
  /// no others: what is thick need not meet as many as a thin tool does. Once.
  void addAnatomySamples(const Points& X, const Eigen::Matrix3Xi& triangles, double spacing);

  /// The samples lie in the middle of a sheet of this thickness [m]: either side of it touches
  /// where a sample is nearer to an obstacle than half of that. Before the first setObstacles().
  void setThickness(double thickness) { margin_ = 0.5 * thickness; }

  /// Those for the anatomy come last.
  const std::vector<SurfaceSample>& samples() const { return samples_; }
  /// What instruments meet: the first of samples(), so many.
  int numForInstruments() const { return for_anatomy_ ? for_anatomy_->sample : numSamples(); }
  /// From the samples: see Response::reach().
  double reach() const { return response_->reach() + margin_ + largest_offset_; }

  /// Of the samples, 3 x their number: see SurfaceSample::offset.
  void setOffsets(const Points& offsets);

  /// Places the obstacles where their ways end; a step has begun where they begin. Same number and
  /// order as at the last findCandidates(), or call that next.
  void setObstacles(const std::vector<Obstacle>& obstacles);

  /// Takes as candidates of obstacle b all samples that are less than `reach[b]` [m] from it at x.
  void findCandidates(const Points& x, const std::vector<double>& reach);
  bool hasCandidates() const { return numCandidates() > 0; }
  /// Of one of the posed obstacles.
  bool hasCandidates(int obstacle) const;
  int numObstacles() const { return static_cast<int>(posed_.size()); }
  int numCandidates() const;
  /// Samples, times obstacles, that the last findCandidates() did not take.
  int numDistant() const;

  /// What the surface is borne by: `free`, 3 x n, see fem::FreeMask, `masses` of the nodes, n [kg],
  /// and `stiffness` around them, n: Young's modulus over the length of an edge [Pa/m]. Samples
  /// that cannot move are answered, but the response learns nothing from them: what presses there
  /// has nothing to give way.
  void setBearing(const Eigen::Matrix3Xd& free, const Eigen::VectorXd& masses,
                  const Eigen::VectorXd& stiffness);

  /// What is left out: samples out of reach, derivatives of samples that do not touch. Both by
  /// default; the sums are the same without.
  void setSkips(bool distant, bool inactive);
  /// The nodes that candidates lie between, ascending.
  void candidateNodes(std::vector<int>* nodes) const;

  /// += the forces on the nodes, 3 x n [N], that touches at x gain, to first order, while obstacle
  /// k moves by motions[k] and x stays. False: there are none.
  bool addPush(const Points& x, const std::vector<Pose>& motions, Points* push) const;

  double value(const Points& x) const override;
  double addGradient(const Points& x, Points* g) const override;
  void addHessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const override;

  /// No sample may go deeper into an obstacle than half of what is left to its
  /// middle, so that it stays on the side from
  /// which it came.
  double maxStep(const Points& x, const Points& d) const override;

  /// How far each obstacle, which goes `ways` [m] in a cycle, may move at once [m] until its
  /// nearest candidate at x is as deep as that, or as half an edge of the triangle around it is
  /// long: elements that are pushed farther in one go fold.
  void allowedMotions(const Points& x, const std::vector<double>& ways,
                      std::vector<double>* allowed) const;

  /// All candidates that answer at x, in a fixed order.
  void collect(const Points& x, std::vector<Contact>* contacts) const;
  /// Second derivative of the energy of one of them by its sample's position [N/m], and the
  /// positive semidefinite part of it.
  Mat3 stiffness(const Contact& contact) const {
    return response_->stiffness(contact.touch, fem::Tangent::kExact);
  }
  Mat3 convexStiffness(const Contact& contact, const Mat3& exact) const {
    return response_->convexStiffness(contact.touch, exact, contact.force_W);
  }
  /// All candidates inside an obstacle at x, whatever answers them; without their motions.
  void penetrating(const Points& x, std::vector<Touch>* touches) const;
  /// A sample and a posed obstacle, without the motion.
  Touch touch(int sample, int obstacle, const Points& x) const;

  /// A step begins at x, where the posed obstacles' ways begin.
  void beginStep(const Points& x);
  /// Whether the response is content with x, a solution within the step; if not, augment() and
  /// solve again.
  bool augmentationConverged(const Points& x);
  void augment(const Points& x);
  /// The step, of `h` [s], has ended with a solution at x, from which the response learns for the
  /// next one.
  void learn(const Points& x, double h);
  bool hasFriction() const { return response_->hasFriction(); }
  /// Whether friction is evaluated for a contact.
  bool rubs(const Contact& contact) const { return response_->rubs(contact.touch); }
  /// It has ended at x.
  void endStep(const Points& x);
  /// The contacts at x, where the last step ended, as they were before that became memory.
  void collectAtEnd(const Points& x, std::vector<Contact>* contacts) const;
  /// Nothing has touched yet.
  void forget();
  /// Takes over what `old` remembers, which is of the same body with another surface; X and old_X
  /// are the points of both at rest, 3 x n [m]. Samples at other places are new.
  void goOnFrom(const ContactPotential& old, const Points& X, const Points& old_X);
  /// What is remembered from step to step, and back to it; empty where nothing is.
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
