// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/contact_potential.h"

#include <algorithm>
#include <limits>

namespace palpate::contact {
namespace {

// How far a point at `distance` [m] may come nearer to a body of inscribed radius r before the next
// look: up to the surface, and half of what is left from there to the middle.
double allowedApproach(double distance, double r) {
  return distance >= 0.0 ? distance + 0.5 * r : 0.5 * std::max(distance + r, 0.0);
}

}  // namespace

ContactPotential::ContactPotential(std::vector<SurfaceSample> samples, Penalty penalty)
    : samples_(std::move(samples)), penalty_(penalty) {
  for (std::size_t s = 0; s < samples_.size(); ++s) {
    if (patches_.empty() || samples_[s].nodes != patches_.back().nodes) {
      patches_.push_back({samples_[s].nodes, static_cast<int>(s), 0});
    }
    patches_.back().end = static_cast<int>(s) + 1;
  }
}

void ContactPotential::setBodies(const std::vector<RigidBody>& bodies) {
  bodies_ = bodies;
  radius_.clear();
  for (const RigidBody& body : bodies_) radius_.push_back(inscribedRadius(*body.geometry));
}

void ContactPotential::findCandidates(const Points& x, const std::vector<double>& reach) {
  candidates_.clear();
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!skip_distant_) {
      for (std::size_t s = 0; s < samples_.size(); ++s) {
        candidates_.push_back({static_cast<int>(s), static_cast<int>(b)});
      }
      continue;
    }
    const Pose X_GW = bodies_[b].X_WG.inverse();
    const double ball = boundingRadius(*bodies_[b].geometry) + reach[b];
    for (const Patch& patch : patches_) {
      // The distance changes by at most the way: skip triangles that are too far as a whole.
      const Vec3 corner = x.col(patch.nodes[0]);
      const double size = std::max((x.col(patch.nodes[1]) - corner).norm(),
                                   (x.col(patch.nodes[2]) - corner).norm());
      const Vec3 corner_G = X_GW * corner;
      if (corner_G.norm() > ball + size) continue;
      if (signedDistanceValue(*bodies_[b].geometry, corner_G) > reach[b] + size) continue;
      for (int s = patch.begin; s < patch.end; ++s) {
        const Vec3 p_G = X_GW * samples_[s].position(x);
        if (signedDistanceValue(*bodies_[b].geometry, p_G) > reach[b]) continue;
        candidates_.push_back({s, static_cast<int>(b)});
      }
    }
  }
}

void ContactPotential::candidateNodes(std::vector<int>* nodes) const {
  nodes->clear();
  for (const Candidate& c : candidates_) {
    const SurfaceSample& s = samples_[c.sample];
    for (int k = 0; k < 3; ++k) {
      if (s.weights[k] != 0.0) nodes->push_back(s.nodes[k]);
    }
  }
  std::sort(nodes->begin(), nodes->end());
  nodes->erase(std::unique(nodes->begin(), nodes->end()), nodes->end());
}

template <class Visit>
void ContactPotential::forEachPenetrating(const Points& x, const Visit& visit) const {
  int body = -1;
  Pose X_GW = Pose::Identity();
  for (const Candidate& c : candidates_) {
    if (c.body != body) {
      body = c.body;
      X_GW = bodies_[body].X_WG.inverse();
    }
    const Vec3 p_W = samples_[c.sample].position(x);
    const Vec3 p_G = X_GW * p_W;
    const double distance = signedDistanceValue(*bodies_[body].geometry, p_G);
    if (distance < 0.0 || !skip_inactive_) visit(c, p_W, p_G, -distance);
  }
}

double ContactPotential::value(const Points& x) const {
  double sum = 0.0;
  forEachPenetrating(x, [&](const Candidate& c, const Vec3&, const Vec3&, double p) {
    sum += samples_[c.sample].area * penalty_.energy(p, radius(c));
  });
  return sum;
}

double ContactPotential::addGradient(const Points& x, Points* g) const {
  double sum = 0.0;
  forEachPenetrating(x, [&](const Candidate& c, const Vec3&, const Vec3& p_G, double p) {
    const SurfaceSample& s = samples_[c.sample];
    const RigidBody& body = bodies_[c.body];
    const Vec3 normal = body.X_WG.linear() * signedDistance(*body.geometry, p_G).normal_G;
    const Vec3 gradient = -s.area * penalty_.pressure(p, radius(c)) * normal;
    for (int k = 0; k < 3; ++k) g->col(s.nodes[k]) += s.weights[k] * gradient;
    sum += s.area * penalty_.energy(p, radius(c));
  });
  return sum;
}

void ContactPotential::addHessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const {
  forEachPenetrating(x, [&](const Candidate& c, const Vec3&, const Vec3& p_G, double p) {
    const SurfaceSample& s = samples_[c.sample];
    const RigidBody& body = bodies_[c.body];
    const Distance d = signedDistance(*body.geometry, p_G);
    Mat3 H_G = penalty_.slope(p, radius(c)) * d.normal_G * d.normal_G.transpose();
    if (tangent == fem::Tangent::kExact) H_G -= penalty_.pressure(p, radius(c)) * d.hessian_G;
    const Mat3 R = body.X_WG.linear();
    K->addPoint<3>(s.nodes, s.weights, s.area * R * H_G * R.transpose());
  });
}

double ContactPotential::maxStep(const Points& x, const Points& d) const {
  double largest = 1.0;
  for (const Candidate& c : candidates_) {
    const RigidBody& body = bodies_[c.body];
    const double r = radius(c);
    const Vec3 motion = samples_[c.sample].position(d);
    const double length = motion.norm();
    const Vec3 p_G = body.X_WG.inverse() * samples_[c.sample].position(x);
    const double allowed = allowedApproach(signedDistanceValue(*body.geometry, p_G), r);
    if (length * largest <= allowed) continue;
    const Vec3 normal_G = signedDistance(*body.geometry, p_G).normal_G;
    const double approach = -(body.X_WG.linear() * normal_G).dot(motion);
    if (approach * largest > allowed) largest = allowed / approach;
  }
  // A sample that is already in the middle must not bring the solve to a stand.
  return std::max(largest, 1e-3);
}

void ContactPotential::allowedMotions(const Points& x, std::vector<double>* allowed) const {
  allowed->assign(bodies_.size(), std::numeric_limits<double>::infinity());
  for (const Candidate& c : candidates_) {
    const RigidBody& body = bodies_[c.body];
    const Vec3 p_G = body.X_WG.inverse() * samples_[c.sample].position(x);
    const double distance = signedDistanceValue(*body.geometry, p_G);
    double& least = (*allowed)[c.body];
    least = std::min(least, allowedApproach(distance, radius(c)));
  }
}

void ContactPotential::collect(const Points& x, std::vector<Contact>* contacts) const {
  contacts->clear();
  forEachPenetrating(x, [&](const Candidate& c, const Vec3& p_W, const Vec3& p_G, double p) {
    if (p <= 0.0) return;
    const SurfaceSample& s = samples_[c.sample];
    const RigidBody& body = bodies_[c.body];
    const Distance d = signedDistance(*body.geometry, p_G);
    const Mat3 R = body.X_WG.linear();
    const double pressure = penalty_.pressure(p, radius(c));
    const Mat3 H_G =
        penalty_.slope(p, radius(c)) * d.normal_G * d.normal_G.transpose() - pressure * d.hessian_G;
    contacts->push_back({c.sample, c.body, p, p_W, -s.area * pressure * (R * d.normal_G),
                         s.area * R * H_G * R.transpose()});
  });
}

}  // namespace palpate::contact
