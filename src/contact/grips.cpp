// SPDX-License-Identifier: GPL-3.0-or-later
#include "grips.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace palpate::contact {
namespace {

// The normal force that limits are of: less by a margin, so that what hardly changes from step to
// step needs no second solution; in the second, third ... of a step by more, and by a part of how
// much it fell since the one before. In the last none is left where it falls still.
struct Caution {
  double margin, fall;
};
constexpr Caution kCautions[] = {{1e-3, 0.5}, {1e-3, 0.2}, {5e-3, 0.5}, {5e-2, 1.0},
                                 {0.2, 1.0},  {0.5, 1.0},  {1.0, 1.0}};
// Of the contact's stiffness: still stiff against tissue, while fewer points than with all of it
// begin or end to slip in a step, each of which Newton's method has to find.
constexpr double kSoftness = 0.05;
// Friction beyond Coulomb's, of all touches against what they press, that needs no other solution.
constexpr double kLittle = 1e-4;
constexpr double kRoundoff = 1e-13;

bool gripBefore(const Grip& a, const Grip& b) { return a.anchor.before(b.anchor); }

bool isTight(const Grip& grip) { return grip.limit > 0.0 || grip.anchor.bite == Bite::kHeld; }

}  // namespace

const Grip* Grips::find(const Touch& touch) const {
  using Place = std::pair<int, int>;
  const auto place_of = [](const Grip& grip) {
    return Place(grip.anchor.number, grip.anchor.sample);
  };
  const Place place(touch.number, touch.sample);
  const auto is_bound = [&](std::size_t k) {  // the first that is not before it
    return k <= grips_.size() && (k == grips_.size() || place <= place_of(grips_[k])) &&
           (k == 0 || place_of(grips_[k - 1]) < place);
  };
  // Touches are asked for in their order, each some times.
  if (!is_bound(bound_)) {
    if (is_bound(bound_ + 1)) {
      ++bound_;
    } else {
      const auto found =
          std::lower_bound(grips_.begin(), grips_.end(), place,
                           [&](const Grip& a, const Place& b) { return place_of(a) < b; });
      bound_ = static_cast<std::size_t>(found - grips_.begin());
    }
  }
  return bound_ < grips_.size() && place_of(grips_[bound_]) == place ? &grips_[bound_] : nullptr;
}

Grip* Grips::findAmong(const Touch& touch) { return const_cast<Grip*>(find(touch)); }

bool Grips::clings(const Touch& touch) const {
  if (const Grip* grip = find(touch)) return isTight(*grip);
  if (!grips_.empty()) return false;
  const Anchor* anchor = anchors_.find(touch);  // a step begins
  return anchor && anchor->bite == Bite::kHeld;
}

bool Grips::clings(int number, int first, int last) const {
  if (grips_.empty()) return anchors_.hold(number, first, last);
  Grip from;
  from.anchor.number = number;
  from.anchor.sample = first;
  for (auto grip = std::lower_bound(grips_.begin(), grips_.end(), from, gripBefore);
       grip != grips_.end() && grip->anchor.number == number && grip->anchor.sample <= last;
       ++grip) {
    if (isTight(*grip)) return true;
  }
  return false;
}

// Of the spring along the surface [N/m].
double Grips::springOf(const Touch& touch) const { return kSoftness * touch.area * stiffness_; }

Vec3 Grips::stretch(const Grip& grip, const Touch& touch) const {
  const Vec3 normal = touch.R_WG * grip.normal_G;
  const Vec3 all = touch.R_WG * grip.anchor.stretch_G + touch.motion_W;
  return all - normal * normal.dot(all);
}

double Grips::energy(const Grip& grip, const Touch& touch) const {
  const double k = springOf(touch), d = stretch(grip, touch).norm();
  if (grip.anchor.bite == Bite::kHeld) {
    return 0.5 * (k * d * d + tension(grip, touch) * std::max(touch.gap, 0.0));
  }
  const double L = grip.limit;
  return k * d <= L ? 0.5 * k * d * d : L * (d - 0.5 * L / k);
}

Vec3 Grips::force(const Grip& grip, const Touch& touch) const {
  const double k = springOf(touch);
  const Vec3 d = stretch(grip, touch);
  const double length = d.norm();
  if (grip.anchor.bite == Bite::kHeld || k * length <= grip.limit) return k * d;
  return grip.limit / length * d;
}

double Grips::tension(const Grip& grip, const Touch& touch) const {
  if (grip.anchor.bite != Bite::kHeld) return 0.0;
  return touch.area * stiffness_ * std::max(touch.gap, 0.0);
}

Mat3 Grips::stiffness(const Grip& grip, const Touch& touch, fem::Tangent tangent) const {
  const double k = springOf(touch);
  const Vec3 normal = touch.R_WG * grip.normal_G;
  const Mat3 plane = Mat3::Identity() - normal * normal.transpose();
  if (grip.anchor.bite == Bite::kHeld) {
    Mat3 sum = k * plane;
    if (touch.gap > 0.0) {
      Mat3 H_G = touch.steepness * touch.steepness * touch.normal_G * touch.normal_G.transpose();
      if (tangent == fem::Tangent::kExact) H_G += touch.gap * touch.curvature_G;
      sum += touch.area * stiffness_ * touch.R_WG * H_G * touch.R_WG.transpose();
    }
    return sum;
  }
  if (grip.limit == 0.0) return Mat3::Zero();
  const Vec3 d = stretch(grip, touch);
  const double length = d.norm();
  if (k * length <= grip.limit) return k * plane;
  const Vec3 along = d / length;
  return grip.limit / length * (plane - along * along.transpose());
}

double Grips::pressing(const Touch& touch) const {
  if (!(touch.gap < normal_.reach()) || !normal_.active(touch)) return 0.0;
  return std::max(-normal_.force(touch).normal, 0.0);
}

// The most friction that Coulomb's law has for the force on this touch, of which a part is along
// its normal where that is not the grip's [N].
double Grips::allowed(const Grip& grip, const Touch& touch) const {
  const double mu = table_.of(touch.number).coefficient(grip.anchor.slides);
  const Vec3 d = stretch(grip, touch);
  const double length = d.norm();
  double share = 1.0;
  if (length > 0.0) {
    const double off = touch.normal_W.dot(d) / length;
    share = std::max((d / length - off * touch.normal_W).norm() + mu * off, kRoundoff);
  }
  return mu * pressing(touch) / share;
}

void Grips::begin(const std::vector<Touch>& touches) {
  grips_.clear();
  round_ = 0;
  for (const Touch& touch : touches) {
    const Friction& friction = table_.of(touch.number);
    if (touch.sample < 0 || !friction.any()) continue;
    // What the step before ended with: the normal response may have learnt from that.
    const Anchor* known = anchors_.find(touch);
    const double N = known ? known->pressing : pressing(touch);
    if (!known && !(N > 0.0)) continue;
    Grip grip;
    if (known) grip.anchor = *known;
    grip.anchor.number = touch.number;
    grip.anchor.sample = touch.sample;
    grip.normal_G = touch.normal_G;
    grip.begin = N;
    const double expected = std::clamp(N + grip.anchor.rise, 0.0, 2.0 * N);
    grip.pressing = cautious(expected, expected + std::abs(grip.anchor.rise));
    grip.limit = friction.coefficient(grip.anchor.slides) * grip.pressing;
    grips_.push_back(grip);
  }
  std::sort(grips_.begin(), grips_.end(), gripBefore);
}

// What each obstacle presses with, less what it draws by.
void Grips::sumPressing(const std::vector<Touch>& touches) {
  presses_.clear();
  for (const Touch& touch : touches) {
    if (!(table_.of(touch.number).teeth > 0.0)) continue;
    const Grip* grip = find(touch);
    const double N = pressing(touch) - (grip ? tension(*grip, touch) : 0.0);
    const auto sum = std::find_if(presses_.begin(), presses_.end(),
                                  [&](const auto& p) { return p.first == touch.number; });
    if (sum != presses_.end()) {
      sum->second += N;
    } else {
      presses_.emplace_back(touch.number, N);
    }
  }
}

bool Grips::presses(int number) const {
  return std::any_of(presses_.begin(), presses_.end(),
                     [&](const auto& p) { return p.first == number && p.second > 0.0; });
}

double Grips::cautious(double N, double before) const {
  const Caution& c = kCautions[std::min<std::size_t>(round_, std::size(kCautions) - 1)];
  return (1.0 - c.margin) * std::max(N - c.fall * std::max(before - N, 0.0), 0.0);
}

// Whether teeth hold it no longer.
bool Grips::letGo(const Touch& touch, bool change, Grip* grip) const {
  if (grip->anchor.bite != Bite::kHeld) return false;
  const double drawn = std::hypot(force(*grip, touch).norm(), tension(*grip, touch));
  const bool torn = drawn > table_.of(touch.number).teeth * touch.area;
  if (!torn && presses(touch.number)) return false;
  if (change) grip->anchor.bite = torn ? Bite::kTorn : Bite::kNone;
  return true;
}

// Whether the grip must be another one for this touch.
bool Grips::reviewOne(const Touch& touch, bool change, Grip* grip) {
  const bool freed = letGo(touch, change, grip);
  if (grip->anchor.bite == Bite::kHeld) return freed;
  const Friction& friction = table_.of(touch.number);
  const double drawn = springOf(touch) * stretch(*grip, touch).norm();
  const bool slips = !grip->anchor.slides && drawn > grip->limit;
  if (slips && change) grip->anchor.slides = true;
  const double N = pressing(touch);
  pressing_ += N;
  excess_ += std::max(std::min(drawn, grip->limit) - allowed(*grip, touch), 0.0);
  if (change) {
    const double next = cautious(N, grip->pressing);
    grip->pressing = round_ == 1 ? next : std::min(grip->pressing, next);
    grip->limit = friction.coefficient(grip->anchor.slides) * grip->pressing;
    grip->normal_G = touch.normal_G;
  }
  return freed || (slips && friction.sliding < friction.at_rest);
}

bool Grips::review(const std::vector<Touch>& touches, bool change) {
  if (grips_.empty()) return false;
  sumPressing(touches);
  if (change) ++round_;
  bool any = false;
  pressing_ = excess_ = 0.0;
  for (const Touch& touch : touches) {
    if (Grip* grip = findAmong(touch)) any |= reviewOne(touch, change, grip);
  }
  return any || excess_ > kLittle * pressing_;
}

void Grips::confine(const std::vector<Touch>& touches) {
  for (const Touch& touch : touches) {
    if (Grip* grip = findAmong(touch)) {
      grip->limit = std::min(grip->limit, allowed(*grip, touch));
    }
  }
}

// The anchors of what touches now: pressed, or held.
void Grips::end(const std::vector<Touch>& touches) {
  sumPressing(touches);
  next_.clear();
  for (const Touch& touch : touches) {
    const Friction& friction = table_.of(touch.number);
    if (touch.sample < 0 || !friction.any()) continue;
    Grip* grip = findAmong(touch);
    if (grip) letGo(touch, true, grip);
    const bool held = grip && grip->anchor.bite == Bite::kHeld;
    const double N = pressing(touch);
    if (!held && !(N > 0.0)) continue;
    Anchor anchor;
    if (grip) {
      const double k = springOf(touch);
      anchor = grip->anchor;
      anchor.rise = N - grip->begin;
      anchor.stretch_G = touch.R_WG.transpose() * force(*grip, touch) / k;
      anchor.slides = !held && k * stretch(*grip, touch).norm() >= grip->limit;
    }
    anchor.number = touch.number;
    anchor.sample = touch.sample;
    anchor.pressing = N;
    const bool bites = friction.teeth > 0.0 && anchor.bite == Bite::kNone;
    if (bites && N > 0.0 && presses(touch.number)) anchor.bite = Bite::kHeld;
    next_.push_back(anchor);
  }
  anchors_.take(next_);
  grips_.clear();
}

void Grips::goOnFrom(const Grips& old, const std::function<int(int)>& now) {
  anchors_.goOnFrom(old.anchors_, now);
  grips_.clear();
}

void Grips::forget() {
  anchors_.clear();
  grips_.clear();
}

void Grips::restore(StateReader* from) {
  anchors_.restore(from);
  grips_.clear();
}

}  // namespace palpate::contact
