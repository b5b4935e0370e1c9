// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/contact_potential.h"

namespace palpate::contact {

void ContactPotential::findCandidates(const Points& x, const std::vector<double>& reach) {
  candidates_.clear();
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Pose X_GW = bodies_[b].X_WG.inverse();
    const double ball = boundingRadius(*bodies_[b].geometry) + reach[b];
    for (std::size_t s = 0; s < samples_.size(); ++s) {
      const Vec3 p_G = X_GW * samples_[s].position(x);
      if (p_G.squaredNorm() > ball * ball) continue;
      if (signedDistanceValue(*bodies_[b].geometry, p_G) > reach[b]) continue;
      candidates_.push_back({static_cast<int>(s), static_cast<int>(b)});
    }
  }
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
    if (distance < 0.0) visit(c, p_W, p_G, -distance);
  }
}

double ContactPotential::value(const Points& x) const {
  double sum = 0.0;
  forEachPenetrating(x, [&](const Candidate& c, const Vec3&, const Vec3&, double p) {
    sum += samples_[c.sample].area * penalty_.energy(p);
  });
  return sum;
}

double ContactPotential::addGradient(const Points& x, Points* g) const {
  double sum = 0.0;
  forEachPenetrating(x, [&](const Candidate& c, const Vec3&, const Vec3& p_G, double p) {
    const SurfaceSample& s = samples_[c.sample];
    const RigidBody& body = bodies_[c.body];
    const Vec3 normal = body.X_WG.linear() * signedDistance(*body.geometry, p_G).normal_G;
    const Vec3 gradient = -s.area * penalty_.pressure(p) * normal;
    for (int k = 0; k < 3; ++k) g->col(s.nodes[k]) += s.weights[k] * gradient;
    sum += s.area * penalty_.energy(p);
  });
  return sum;
}

void ContactPotential::addHessian(const Points& x, fem::Tangent tangent,
                                  fem::BlockMatrix* K) const {
  forEachPenetrating(x, [&](const Candidate& c, const Vec3&, const Vec3& p_G, double p) {
    const SurfaceSample& s = samples_[c.sample];
    const RigidBody& body = bodies_[c.body];
    const Distance d = signedDistance(*body.geometry, p_G);
    Mat3 H_G = penalty_.slope(p) * d.normal_G * d.normal_G.transpose();
    if (tangent == fem::Tangent::kExact) H_G -= penalty_.pressure(p) * d.hessian_G;
    const Mat3 R = body.X_WG.linear();
    const Mat3 H = s.area * R * H_G * R.transpose();
    for (int k = 0; k < 3; ++k) {
      for (int l = 0; l < 3; ++l) {
        const double w = s.weights[k] * s.weights[l];
        if (w != 0.0) K->block(K->find(s.nodes[k], s.nodes[l])) += w * H;
      }
    }
  });
}

void ContactPotential::collect(const Points& x, std::vector<Contact>* contacts) const {
  contacts->clear();
  forEachPenetrating(x, [&](const Candidate& c, const Vec3& p_W, const Vec3& p_G, double p) {
    const SurfaceSample& s = samples_[c.sample];
    const RigidBody& body = bodies_[c.body];
    const Vec3 normal = body.X_WG.linear() * signedDistance(*body.geometry, p_G).normal_G;
    contacts->push_back({c.sample, c.body, p, p_W, -s.area * penalty_.pressure(p) * normal});
  });
}

}  // namespace palpate::contact
