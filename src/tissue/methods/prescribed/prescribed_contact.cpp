// SPDX-License-Identifier: GPL-3.0-or-later
#include "prescribed_contact.h"

#include <algorithm>

namespace palpate::tissue {
namespace {

constexpr double kPenetration = 1e-6;  // least penetration over the body's size [-]
// Least norm of the gap's gradient for a distance from the surface [-].
constexpr double kLeastSteepness = 0.5;

bool isVertex(const contact::SurfaceSample& s) { return s.weights.maxCoeff() == 1.0; }

// Calls visit(node) for the sample's nodes of nonzero weight.
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

void PrescribedContact::goBack() {
  holds_ = kept_;
  updateMask();
}

void PrescribedContact::save(StateWriter* to) const {
  to->put(static_cast<std::int64_t>(holds_.size()));
  for (const Hold& h : holds_) {
    to->put(h.sample);
    to->put(h.number);
  }
}

void PrescribedContact::restore(StateReader* from) {
  std::vector<Hold> holds(static_cast<std::size_t>(from->count(2 * sizeof(int))));
  const auto samples = static_cast<int>(body_.contact.samples().size());
  for (Hold& h : holds) {
    from->get(&h.sample);
    from->get(&h.number);
    if (h.sample < 0 || h.sample >= samples) StateReader::fail();
  }
  holds_.swap(holds);
  updateMask();
}

void PrescribedContact::updateMask() {
  held_ = body_.free;
  for (const Hold& h : holds_) {
    forNodes(body_.contact.samples()[h.sample], [&](int node) { held_.col(node).setZero(); });
  }
}

double PrescribedContact::nextStage(const Points& x, double s, double end) {
  return body_.tool_path.next(x, s, end);
}

void PrescribedContact::beginStage(const Points&, double, double) {
  const auto gone = [this](Hold& h) {
    h.obstacle = body_.tool_path.find(h.number);
    return h.obstacle < 0;
  };
  holds_.erase(std::remove_if(holds_.begin(), holds_.end(), gone), holds_.end());
  updateMask();
}

void PrescribedContact::moves(const Points& x, Points* move) const {
  move->setZero(3, x.cols());
  for (const Hold& h : holds_) {
    const contact::Touch touch = body_.contact.touch(h.sample, h.obstacle, x);
    const double steepness = std::max(touch.steepness, kLeastSteepness);
    const Vec3 way = -touch.gap / steepness * touch.normal_W;  // to the surface
    forNodes(body_.contact.samples()[h.sample],
             [&](int node) { move->col(node) = way.cwiseProduct(body_.free.col(node)); });
  }
}

// Whether no node of the sample is held by a tool, and one is free.
bool PrescribedContact::free(int sample) const {
  bool movable = false, held = false;
  forNodes(body_.contact.samples()[sample], [&](int node) {
    movable = movable || !body_.free.col(node).isZero();
    held = held || held_.col(node) != body_.free.col(node);
  });
  return movable && !held;
}

void PrescribedContact::hold(const contact::Touch& touch) {
  holds_.push_back({touch.sample, touch.number, touch.obstacle});
  forNodes(body_.contact.samples()[touch.sample], [&](int node) { held_.col(node).setZero(); });
}

bool PrescribedContact::holdWhatPenetrates(const Points& x) {
  body_.contact.penetrating(x, &touches_);
  const auto before = holds_.size();
  std::stable_sort(touches_.begin(), touches_.end(), [this](const auto& a, const auto& b) {
    const bool vertex_a = isVertex(body_.contact.samples()[a.sample]);
    const bool vertex_b = isVertex(body_.contact.samples()[b.sample]);
    return vertex_a != vertex_b ? vertex_a : a.penetration() > b.penetration();
  });
  for (const contact::Touch& touch : touches_) {
    if (touch.penetration() > kPenetration * body_.size && free(touch.sample)) hold(touch);
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
    return force(h, gradient).dot(body_.contact.touch(h.sample, h.obstacle, x).normal_W) < 0.0;
  };
  holds_.erase(std::remove_if(holds_.begin(), holds_.end(), pulls), holds_.end());
  updateMask();
  return holds_.size() < before;
}

double PrescribedContact::nodalNorm(const Points& gradient) const {
  return (gradient.array() * (body_.free.array() - held_.array())).matrix().norm();
}

void PrescribedContact::report(const Points& x, const Points& gradient, TissueStep* out) const {
  for (const Hold& h : holds_) {
    const Vec3 p_W = body_.contact.samples()[h.sample].position(x);
    out->contacts.push_back({body_.tool_path.owner(h.obstacle), 0.0, p_W, -force(h, gradient)});
  }
}

}  // namespace palpate::tissue
