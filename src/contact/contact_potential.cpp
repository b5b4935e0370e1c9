// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/contact_potential.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "contact_candidates.h"
#include "face_points.h"
#include "palpate/contact/signed_distance.h"
#include "sample_ball.h"

namespace palpate::contact {
namespace {

constexpr int kSamplesOfPart = 16;  // samples

}  // namespace

ContactPotential::ContactPotential(std::vector<SurfaceSample> samples,
                                   std::unique_ptr<Response> response)
    : samples_(std::move(samples)),
      response_(std::move(response)),
      runs_(std::make_unique<SampleRuns>()) {
  addPatches(0);
}

// Adds the patches of the samples from `first_sample` on.
void ContactPotential::addPatches(int first_sample) {
  const std::size_t first = patches_.size();
  for (int s = first_sample; s < numSamples(); ++s) {
    if (patches_.size() == first || samples_[s].nodes != patches_.back().nodes) {
      patches_.push_back({samples_[s].nodes, s, 0, -1, 0, 0});
    }
    patches_.back().end = s + 1;
  }
  const auto weights = [this](int s) -> const Vec3& { return samples_[s].weights; };
  for (std::size_t p = first; p < patches_.size(); ++p) {
    Patch& patch = patches_[p];
    patch.first_part = static_cast<int>(parts_.size());
    for (int begin = patch.begin; begin < patch.end; begin += kSamplesOfPart) {
      const int end = std::min(begin + kSamplesOfPart, patch.end);
      parts_.push_back({begin, end, SampleBall::around(begin, end, weights)});
    }
    patch.last_part = static_cast<int>(parts_.size());
  }
}

ContactPotential::~ContactPotential() = default;

void ContactPotential::addFaceContact(const Points& X, const Eigen::Matrix3Xi& triangles,
                                      double spacing) {
  faces_ = std::make_unique<FacePoints>();
  faces_->setSurface(X, triangles, spacing);
  nodes_only_ = !(spacing > 0.0);  // some triangles then have no samples
  // Samples and triangles are in the same order.
  Eigen::Index t = 0;
  const int end = for_anatomy_ ? for_anatomy_->patch : numPatches();
  for (int p = 0; p < end; ++p) {
    Patch& patch = patches_[p];
    while (t < triangles.cols() && triangles.col(t) != patch.nodes) ++t;
    if (t < triangles.cols()) patch.triangle = static_cast<int>(t);
  }
}

void ContactPotential::addAnatomySamples(const Points& X, const Eigen::Matrix3Xi& triangles,
                                         double spacing) {
  for_anatomy_ = {numPatches(), numSamples()};
  const std::vector<SurfaceSample> own = sampleSurface(X, triangles, spacing);
  samples_.insert(samples_.end(), own.begin(), own.end());
  addPatches(for_anatomy_->sample);
}

void ContactPotential::setOffsets(const Points& offsets) {
  largest_offset_ = std::sqrt(offsets.colwise().squaredNorm().maxCoeff());
  for (std::size_t s = 0; s < samples_.size(); ++s) {
    samples_[s].offset = offsets.col(static_cast<Eigen::Index>(s));
  }
}

// Calls visit(touch) for candidate samples at x, or for possibly active ones. Measures what
// Response::energy() needs, or `with_frame` all.
template <class Visit>
void ContactPotential::forSamples(const Points& x, bool skip_inactive, bool with_frame,
                                  const Visit& visit) const {
  const double reach = response_->reach();
  const bool motion = response_->followsMotion();
  const bool may_cling = response_->remembers();
  const auto clings = [&](int obstacle, int first, int last) {
    return may_cling && response_->clings(posed_[obstacle].obstacle().number, first, last);
  };
  const auto far = [&](const SampleRuns::Run& run, double least) {
    return least >= reach &&
           !clings(run.obstacle, candidates_[run.begin].sample, candidates_[run.end - 1].sample);
  };
  Touch touch;
  touch.motion_W.setZero();
  const auto look = [&](const SampleCandidate& c) {
    const SurfaceSample& s = samples_[c.sample];
    const PosedObstacle& obstacle = posed_[c.obstacle];
    obstacle.measureGap(s.position(x), &touch);
    if (skip_inactive && !(touch.gap < reach) && !clings(c.obstacle, c.sample, c.sample)) return;
    touch.sample = c.sample;
    touch.obstacle = c.obstacle;
    touch.nodes = s.nodes;
    touch.weights = s.weights;
    touch.area = s.area;
    touch.offset = s.offset;
    touch.bearing = bearingOf(touch);
    if (skip_inactive && !response_->active(touch)) return;
    if (with_frame || motion) obstacle.measureFrame(&touch);
    if (motion && begun_) obstacle.measureMotion(s.position(x_begin_), &touch);
    visit(touch);
  };
  if (skip_inactive) {
    forCandidates(x, far, look);
  } else {
    for (const SampleCandidate& c : candidates_) look(c);
  }
}

// The same for samples and balls.
template <class Visit>
void ContactPotential::forEach(const Points& x, bool skip_inactive, bool with_frame,
                               const Visit& visit) const {
  forSamples(x, skip_inactive, with_frame, visit);
  forFaces(x, [&](Touch& touch, const FacePoints::BallTrianglePair&) { visit(touch); });
}

// Calls visit(touch, pair) for balls that may be active.
template <class Visit>
void ContactPotential::forFaces(const Points& x, const Visit& visit) const {
  if (!faces_) return;
  const bool motion = response_->followsMotion() && begun_;
  faces_->forEach(x, posed_, response_->reach(), [&](Touch* touch, const auto& pair) {
    // Constant along triangles, as the energy's derivatives assume.
    touch->bearing = bearing_.size() == 0 ? 0.0 : bearing_(faces_->nodesOf(pair.first)).mean();
    if (!response_->active(*touch)) return;
    if (motion) posed_[touch->obstacle].measureMotion(touch->of(x_begin_), touch);
    visit(*touch, pair);
  });
}

double ContactPotential::value(const Points& x) const {
  double sum = 0.0;
  forEach(x, skip_inactive_, false, [&](const Touch& touch) { sum += response_->energy(touch); });
  return sum;
}

double ContactPotential::addGradient(const Points& x, Points* g) const {
  double sum = 0.0;
  forEach(x, skip_inactive_, true, [&](const Touch& touch) {
    const TouchForce f = response_->force(touch);
    const Vec3 force = f.normal * touch.normal_W + f.other_W;
    for (int k = 0; k < 3; ++k) g->col(touch.nodes[k]) += touch.weights[k] * force;
    sum += response_->energy(touch);
  });
  return sum;
}

void ContactPotential::addHessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const {
  forSamples(x, skip_inactive_, true, [&](const Touch& touch) {
    K->addPoint<3>(touch.nodes, touch.weights, response_->stiffness(touch, tangent));
  });
  forFaces(x, [&](const Touch& touch, const FacePoints::BallTrianglePair& pair) {
    K->addPoint<3>(touch.nodes, touch.weights, response_->stiffness(touch, tangent));
    if (tangent != fem::Tangent::kExact) return;
    // Derivative by the nearest point of the triangle.
    Mat3 corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = x.col(touch.nodes[k]);
    const Eigen::Matrix<double, 9, 9> H =
        response_->force(touch).normal *
        triangleDistanceHessian(corners, pair.near, pair.direction, pair.distance);
    K->add(touch.nodes, H);
  });
}

bool ContactPotential::addPush(const Points& x, const std::vector<Pose>& motions,
                               Points* push) const {
  bool any = false;
  forEach(x, skip_inactive_, true, [&](const Touch& touch) {
    const Vec3& p = touch.p_W;
    const Pose& motion = motions[static_cast<std::size_t>(touch.obstacle)];
    // Equal to the opposite motion of the sample, plus the force rotated with the obstacle.
    const TouchForce f = response_->force(touch);
    const Vec3 now = -(f.normal * touch.normal_W + f.other_W);
    const Vec3 force = response_->stiffness(touch, fem::Tangent::kExact) * (motion * p - p) +
                       (motion.linear() * now - now);
    for (int k = 0; k < 3; ++k) push->col(touch.nodes[k]) += touch.weights[k] * force;
    any |= force != Vec3::Zero();
  });
  return any;
}

void ContactPotential::collect(const Points& x, std::vector<Contact>* contacts) const {
  contacts->clear();
  forEach(x, true, true, [&](const Touch& touch) {
    const TouchForce f = response_->force(touch);
    // Eigen evaluates this product first: the last bit may differ from addGradient().
    const Vec3 normal_force = f.normal * (touch.R_WG * touch.normal_G);
    contacts->emplace_back(touch, normal_force + f.other_W);
  });
}

void ContactPotential::penetrating(const Points& x, std::vector<Touch>* touches) const {
  touches->clear();
  const auto isOutside = [](const auto&, double least) { return least >= 0.0; };
  forCandidates(x, isOutside, [&](const SampleCandidate& c) {
    if (!(posed_[c.obstacle].gap(samples_[c.sample].position(x)) < 0.0)) return;
    touches->push_back(touch(c.sample, c.obstacle, x));
  });
}

Touch ContactPotential::touch(int sample, int obstacle, const Points& x) const {
  Touch touch;
  touch.sample = sample;
  touch.obstacle = obstacle;
  touch.nodes = samples_[sample].nodes;
  touch.weights = samples_[sample].weights;
  touch.area = samples_[sample].area;
  touch.offset = samples_[sample].offset;
  touch.bearing = bearingOf(touch);
  posed_[obstacle].measureGap(samples_[sample].position(x), &touch);
  posed_[obstacle].measureFrame(&touch);
  touch.motion_W.setZero();
  return touch;
}

void ContactPotential::gather(const Points& x) {
  touches_.clear();
  forEach(x, true, true, [&](const Touch& touch) { touches_.push_back(touch); });
}

void ContactPotential::setBearing(const Eigen::Matrix3Xd& free, const Eigen::VectorXd& masses,
                                  const Eigen::VectorXd& stiffness) {
  masses_ = masses;
  for (Eigen::Index i = 0; i < masses.size(); ++i) {
    if (free.col(i).isZero()) masses_[i] = std::numeric_limits<double>::infinity();
  }
  bearing_ = stiffness;
}

// Stiffness scale at a sample [Pa/m].
double ContactPotential::bearingOf(const Touch& touch) const {
  if (bearing_.size() == 0) return 0.0;
  const Vec3 of_corners = bearing_(touch.nodes);
  return of_corners.dot(touch.weights);
}

// Inverse of the sample's mass [1/kg].
double ContactPotential::mobilityOf(const Touch& touch) const {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) {
    sum += touch.weights[k] * touch.weights[k] / masses_[touch.nodes[k]];
  }
  return sum;
}

void ContactPotential::gatherLearnable(const Points& x, double h) {
  touches_.clear();
  const bool begun = begun_ && x_begin_.cols() == x.cols();
  Vec3 together = Vec3::Zero();
  if (begun) together = (x - x_begin_).rowwise().mean();
  forEach(x, true, true, [&](Touch& touch) {
    touch.inertia = 0.0;
    if (masses_.size() > 0) {
      const double mobility = mobilityOf(touch);
      if (mobility == 0.0) return;
      touch.inertia = 1.0 / (mobility * h * h);
    }
    const Vec3 p_begin_W = begun ? touch.of(x_begin_) + touch.offset : touch.p_W;
    posed_[static_cast<std::size_t>(touch.obstacle)].measureMotion(p_begin_W, &touch);
    touch.travel = (touch.p_W - p_begin_W - together).norm();
    touches_.push_back(touch);
  });
}

}  // namespace palpate::contact
