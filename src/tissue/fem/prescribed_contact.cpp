// SPDX-License-Identifier: GPL-3.0-or-later
#include "prescribed_contact.h"

#include <algorithm>

#include "palpate/contact/signed_distance.h"

namespace palpate::tissue {
namespace {

constexpr double kPenetration = 1e-6;  // that counts, of the body's size

bool isVertex(const contact::SurfaceSample& s) { return s.weights.maxCoeff() == 1.0; }

// Calls visit(node) for the nodes that the sample lies between.
template <class Visit>
void forNodes(const contact::SurfaceSample& s, const Visit& visit) {
  for (int k = 0; k < 3; ++k) {
    if (s.weights[k] != 0.0) visit(s.nodes[k]);
  }
}

}  // namespace

void PrescribedContact::clear() {
  holds_.clear();
  updateMask();
}

void PrescribedContact::restore(const PrescribedContact& earlier) {
  holds_ = earlier.holds_;
  updateMask();
}

void PrescribedContact::updateMask() {
  held_ = body_.free;
  for (const Hold& h : holds_) {
    forNodes(body_.contact.samples()[h.sample], [&](int node) { held_.col(node).setZero(); });
  }
}

void PrescribedContact::beginStage() {
  const auto gone = [this](Hold& h) {
    for (h.body = 0; h.body < body_.sweep.numBodies(); ++h.body) {
      const contact::RigidBody& body = body_.sweep.placed(h.body);
      if (body.geometry == h.geometry && body.instrument == h.instrument) return false;
    }
    return true;
  };
  holds_.erase(std::remove_if(holds_.begin(), holds_.end(), gone), holds_.end());
  updateMask();
}

// From the point at x to the tool's surface, and the normal there.
Vec3 PrescribedContact::onSurface(const Hold& hold, const Points& x, Vec3* normal) const {
  const contact::RigidBody& body = body_.sweep.placed(hold.body);
  const Vec3 p_G = body.X_WG.inverse() * body_.contact.samples()[hold.sample].position(x);
  const contact::Distance d = contact::signedDistance(*body.geometry, p_G);
  *normal = body.X_WG.linear() * d.normal_G;
  return -d.value * *normal;
}

void PrescribedContact::moves(const Points& x, Points* move) const {
  move->setZero(3, x.cols());
  Vec3 normal;
  for (const Hold& h : holds_) {
    const Vec3 way = onSurface(h, x, &normal);
    forNodes(body_.contact.samples()[h.sample],
             [&](int node) { move->col(node) = way.cwiseProduct(body_.free.col(node)); });
  }
}

// Whether none of the sample's nodes is held, and one can move.
bool PrescribedContact::free(int sample) const {
  bool movable = false, held = false;
  forNodes(body_.contact.samples()[sample], [&](int node) {
    movable = movable || !body_.free.col(node).isZero();
    held = held || held_.col(node) != body_.free.col(node);
  });
  return movable && !held;
}

void PrescribedContact::hold(int sample, int body) {
  const contact::RigidBody& tool = body_.sweep.placed(body);
  holds_.push_back({sample, tool.geometry, tool.instrument, body});
  forNodes(body_.contact.samples()[sample], [&](int node) { held_.col(node).setZero(); });
}

bool PrescribedContact::holdWhatPenetrates(const Points& x) {
  body_.contact.collect(x, &contacts_);
  const auto before = holds_.size();
  std::stable_sort(contacts_.begin(), contacts_.end(), [this](const auto& a, const auto& b) {
    const bool vertex_a = isVertex(body_.contact.samples()[a.sample]);
    const bool vertex_b = isVertex(body_.contact.samples()[b.sample]);
    return vertex_a != vertex_b ? vertex_a : a.penetration > b.penetration;
  });
  for (const contact::Contact& c : contacts_) {
    if (c.penetration > kPenetration * body_.size && free(c.sample)) hold(c.sample, c.body);
  }
  return holds_.size() > before;
}

Vec3 PrescribedContact::force(const Hold& hold, const Points& gradient) const {
  Vec3 sum = Vec3::Zero();
  forNodes(body_.contact.samples()[hold.sample],
           [&](int node) { sum += gradient.col(node).cwiseProduct(body_.free.col(node)); });
  return sum;
}

bool PrescribedContact::release(const Points& x, const Points& gradient) {
  const auto before = holds_.size();
  const auto pulls = [&](const Hold& h) {
    Vec3 normal;
    onSurface(h, x, &normal);
    return force(h, gradient).dot(normal) < 0.0;
  };
  holds_.erase(std::remove_if(holds_.begin(), holds_.end(), pulls), holds_.end());
  updateMask();
  return holds_.size() < before;
}

void PrescribedContact::report(const Points& x, const Points& gradient, TissueStep* out) const {
  for (const Hold& h : holds_) {
    const Vec3 p_W = body_.contact.samples()[h.sample].position(x);
    out->contacts.push_back({h.instrument, 0.0, p_W, -force(h, gradient)});
  }
}

}  // namespace palpate::tissue
