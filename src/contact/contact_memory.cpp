// SPDX-License-Identifier: GPL-3.0-or-later
// State of contact within a step, between steps, and over mesh adaptations.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "palpate/contact/contact_potential.h"
#include "palpate/contact/triangle_distance.h"

namespace palpate::contact {
namespace {

// Distance tolerance of a node on a triangle of another mesh, over the triangle's edge [-].
constexpr double kOnTriangle = 0.1;

}  // namespace

void ContactPotential::beginStep(const Points& x) {
  for (PosedObstacle& obstacle : posed_) obstacle.beginHere();
  begun_ = response_->followsMotion() || response_->remembers();
  if (begun_) x_begin_ = x;
  if (!response_->remembers()) return;
  gather(x);
  response_->beginStep(touches_);
}

bool ContactPotential::augmentationConverged(const Points& x) {
  if (!response_->remembers()) return true;
  gather(x);  // held samples too: they have friction
  return response_->augmentationConverged(touches_);
}

void ContactPotential::augment(const Points& x) {
  if (!response_->remembers()) return;
  gather(x);
  response_->augment(touches_);
}

void ContactPotential::learn(const Points& x, double h) {
  if (!response_->remembers()) return;
  gatherLearnable(x, h);
  response_->learn(touches_);
}

void ContactPotential::endStep(const Points& x) {
  if (!response_->remembers()) return;
  if (response_->hasFriction()) {
    gather(x);
    response_->confine(touches_);
  }
  collect(x, &at_end_);
  touches_.clear();
  for (const Contact& contact : at_end_) touches_.push_back(contact.touch);
  response_->endStep(touches_);
}

void ContactPotential::collectAtEnd(const Points& x, std::vector<Contact>* contacts) const {
  if (response_->remembers()) {
    *contacts = at_end_;
  } else {
    collect(x, contacts);
  }
}

void ContactPotential::goOnFrom(const ContactPotential& old, const Points& X, const Points& old_X) {
  if (!response_->remembers()) return;
  // State belongs to touched samples, so only new samples near them are mapped.
  Eigen::AlignedBox3d box;
  for (const Contact& c : old.at_end_) {
    for (int k = 0; k < 3; ++k) box.extend(Vec3(old_X.col(c.touch.nodes[k])));
  }
  if (box.isEmpty()) return response_->forget();
  const double size = (X.rowwise().maxCoeff() - X.rowwise().minCoeff()).norm();
  const double same = 1e-9 * size;
  std::vector<std::pair<int, Vec3>> samples;
  std::vector<int> nodes;
  for (int s = 0; s < numSamples(); ++s) {
    const Vec3 p = samples_[s].position(X);
    if (box.squaredExteriorDistance(p) > same * same) continue;
    samples.emplace_back(s, p);
    for (int k = 0; k < 3; ++k) nodes.push_back(samples_[s].nodes[k]);
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const auto sampleNow = [&](int sample) {
    const Vec3 q = old.samples_[static_cast<std::size_t>(sample)].position(old_X);
    const bool for_anatomy = old.isForAnatomy(sample);
    for (const auto& [i, p] : samples) {
      if (isForAnatomy(i) == for_anatomy && (p - q).squaredNorm() < same * same) return i;
    }
    return -1;
  };
  response_->goOnFrom(*old.response_, {sampleNow, placesOf(nodes, X, old, old_X)});
}

// Positions of `nodes` on touched triangles of `old`; nodes off all of them are left out.
std::vector<Response::SurfaceMap::Node> ContactPotential::placesOf(const std::vector<int>& nodes,
                                                                   const Points& X,
                                                                   const ContactPotential& old,
                                                                   const Points& old_X) {
  std::vector<Eigen::Vector3i> triangles;
  for (const Contact& c : old.at_end_) {
    if (triangles.empty() || triangles.back() != c.touch.nodes) triangles.push_back(c.touch.nodes);
  }
  std::vector<Response::SurfaceMap::Node> places;
  for (int node : nodes) {
    const Vec3 p = X.col(node);
    Response::SurfaceMap::Node place{node, {}, {}};
    double nearest = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3i& t : triangles) {
      const Vec3 a = old_X.col(t[0]), b = old_X.col(t[1]), c = old_X.col(t[2]);
      const TrianglePoint on = nearestOnTriangle(p, a, b, c);
      const double distance = (on.point - p).norm();
      // Bound of the distance between two surfaces of a body.
      if (distance >= nearest || distance > kOnTriangle * (b - a).norm()) continue;
      nearest = distance;
      place.old = t;
      place.weights = on.weights;
    }
    if (std::isfinite(nearest)) places.push_back(place);
  }
  return places;
}

void ContactPotential::forget() {
  begun_ = false;
  at_end_.clear();
  response_->forget();
}

void ContactPotential::save(StateWriter* to) const {
  if (response_->remembers()) response_->save(to);
}

void ContactPotential::restore(StateReader* from) {
  if (response_->remembers()) response_->restore(from);
}

}  // namespace palpate::contact
