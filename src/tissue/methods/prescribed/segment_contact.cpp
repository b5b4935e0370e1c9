// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment_contact.h"

#include <algorithm>
#include <variant>

#include "palpate/contact/signed_distance.h"
#include "palpate/mesh/cell_mesh.h"
#include "tissue/touch/sweep.h"

namespace palpate::tissue {
namespace {

// Largest tool displacement of a stage over the mean edge [-].
constexpr double kStage = 0.5;

// Half length of a shape's segment along its z axis [m]; 0: no segment.
double halfLength(const instrument::Geometry& geometry) {
  if (const auto* capsule = std::get_if<instrument::Capsule>(&geometry)) {
    return capsule->half_length + capsule->radius;
  }
  const auto* cylinder = std::get_if<instrument::Cylinder>(&geometry);
  return cylinder == nullptr ? 0.0 : cylinder->half_length;
}

bool isTip(double part) { return part == 0.0 || part == 1.0; }

}  // namespace

SegmentContact::SegmentContact(FemBody* body)
    : body_(*body),
      tracker_(body->mesh.points, body->triangles),
      mean_edge_(mesh::meanEdgeLength({body->mesh.points, body->triangles, {}})) {}

void SegmentContact::clear() { hold({}); }

void SegmentContact::keep() {
  kept_ = hold_;
  counted_ = tracker_.counts();
}

void SegmentContact::addWork(TissueStep* out) const {
  out->walk_steps += static_cast<int>(counts().steps - counted_.steps);
  out->tree_queries += static_cast<int>(counts().queries - counted_.queries);
}

void SegmentContact::goBack() { hold(kept_); }

void SegmentContact::save(StateWriter* to) const {
  to->put(hold_.has_value());
  if (!hold_) return;
  to->put(hold_->number);
  to->put(hold_->triangle);
  to->put(hold_->weights);
  to->put(hold_->part);
}

void SegmentContact::restore(StateReader* from) {
  bool any = false;
  from->get(&any);
  if (!any) return hold({});
  Hold held{};
  from->get(&held.number);
  from->get(&held.triangle);
  from->get(&held.weights);
  from->get(&held.part);
  const bool known = held.triangle >= 0 && held.triangle < body_.triangles.cols();
  if (!known || !held.weights.allFinite() || !(held.part >= 0.0 && held.part <= 1.0)) {
    StateReader::fail();
  }
  hold(held);
}

// Points with held components cannot move.
void SegmentContact::hold(const std::optional<Hold>& held) {
  hold_.reset();
  tie_ = TiedPoint();
  if (!held) return;
  const TiedPoint tie(body_.triangles.col(held->triangle), held->weights, body_.free);
  if (!tie.free()) return;
  hold_ = held;
  tie_ = tie;
}

int SegmentContact::findTool() const {
  const std::vector<contact::Obstacle>& near = body_.tool_path.near();
  for (std::size_t k = 0; k < near.size(); ++k) {
    if (!near[k].owner.isInstrument() || (hold_ && near[k].number != hold_->number)) continue;
    if (halfLength(*near[k].geometry) > 0.0) return static_cast<int>(k);
  }
  return -1;
}

SegmentContact::Segment SegmentContact::placed(int obstacle, double s) const {
  const contact::Obstacle& tool = body_.tool_path.near()[static_cast<std::size_t>(obstacle)];
  const Pose X_WG = contact::interpolate(tool.X_WG_begin, tool.X_WG_end, s);
  const Vec3 half = halfLength(*tool.geometry) * Vec3::UnitZ();
  return {X_WG * Vec3(-half), X_WG * half};
}

double SegmentContact::nextStage(const Points&, double s, double end) {
  const int tool = findTool();
  if (tool < 0) return end;
  const contact::Obstacle& o = body_.tool_path.near()[static_cast<std::size_t>(tool)];
  const double way = contact::sweepLength(*o.geometry, o.X_WG_begin, o.X_WG_end);
  const double most = way > 0.0 ? kStage * mean_edge_ / way : 1.0;
  return std::min(end, s + std::max(most, 1.0 / kMaxSweepStages));
}

void SegmentContact::beginStage(const Points& x, double s, double end) {
  released_ = false;
  tool_ = findTool();
  if (tool_ < 0) return clear();
  was_ = placed(tool_, s);
  now_ = placed(tool_, end);
  if (hold_ && isTip(hold_->part)) follow(x);
}

// Moves the tip's hold to the present intersection of the line.
void SegmentContact::follow(const Points& x) {
  const bool at_end = hold_->part == 1.0;
  const Segment tool = at_end ? now_ : Segment{now_.end, now_.begin};
  std::optional<contact::SegmentHit> hit = tracker_.walk(x, tool.begin, tool.end, hold_->triangle);
  if (!hit) hit = entryOf(x, tool);
  const double beyond = hit ? (hit->part - 1.0) * (tool.end - tool.begin).norm() : 0.0;
  if (!hit || !hit->inward || beyond > mean_edge_) return clear();
  hold(Hold{hold_->number, hit->triangle, hit->weights, hold_->part});
}

// Finds the entry nearest to the tip by the tree.
std::optional<contact::SegmentHit> SegmentContact::entryOf(const Points& x, const Segment& tool) {
  tracker_.fit(x);
  tracker_.find(x, tool.begin, tool.end, &hits_);
  if (hits_.empty() || !hits_.back().inward) return std::nullopt;
  return hits_.back();
}

bool SegmentContact::holdWhatPenetrates(const Points& x) {
  if (hold_ || released_ || tool_ < 0) return false;
  tracker_.fit(x);
  tracker_.find(x, now_.begin, now_.end, &hits_);
  if (hits_.empty()) return false;
  hold(choose(x));
  return hold_.has_value();
}

// Chooses the hold of a new contact: the tip, of two inside ends the less deep one.
std::optional<SegmentContact::Hold> SegmentContact::choose(const Points& x) {
  const int number = body_.tool_path.near()[static_cast<std::size_t>(tool_)].number;
  const contact::SegmentHit &first = hits_.front(), &last = hits_.back();
  const bool begin_inside = !first.inward, end_inside = last.inward;
  if (begin_inside && (!end_inside || first.part < 1.0 - last.part)) {
    return Hold{number, first.triangle, first.weights, 0.0};
  }
  if (end_inside) return Hold{number, last.triangle, last.weights, 1.0};
  const contact::SegmentHit* most = nullptr;  // among the entries
  double fastest = 0.0;
  for (const contact::SegmentHit& hit : hits_) {
    const Vec3 motion = now_.at(hit.part) - was_.at(hit.part);
    const double in = -motion.dot(outward(x, hit.triangle));
    if (in > fastest) fastest = in, most = &hit;
  }
  if (most == nullptr) return std::nullopt;
  return Hold{number, most->triangle, most->weights, most->part};
}

bool SegmentContact::release(const Points& x, const Points& gradient) {
  if (!hold_) return false;
  const double pull = tie_.force(gradient).dot(outward(x, hold_->triangle));
  if (!(pull > body_.tolerance())) return false;
  clear();
  released_ = true;
  return true;
}

Vec3 SegmentContact::outward(const Points& x, int triangle) const {
  const Eigen::Vector3i t = body_.triangles.col(triangle);
  return (x.col(t[1]) - x.col(t[0])).cross(x.col(t[2]) - x.col(t[0])).normalized();
}

Vec3 SegmentContact::position(const Points& x) const {
  Vec3 p = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    p += hold_->weights[k] * x.col(body_.triangles(k, hold_->triangle));
  }
  return p;
}

void SegmentContact::moves(const Points& x, Points* move) const {
  move->setZero(3, x.cols());
  if (hold_) tie_.addMove(now_.at(hold_->part) - position(x), move);
}

double SegmentContact::unbalanced(const Points& gradient) const {
  rest_of_ = gradient.cwiseProduct(body_.free);
  tie_.balance(&rest_of_);
  return rest_of_.norm();
}

void SegmentContact::report(const Points& x, const Points& gradient, TissueStep* out) const {
  if (!hold_) return;
  out->contacts.push_back({body_.tool_path.owner(tool_), 0.0, position(x), -tie_.force(gradient)});
}

}  // namespace palpate::tissue
