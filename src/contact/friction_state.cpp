// SPDX-License-Identifier: GPL-3.0-or-later
#include "friction_state.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace palpate::contact {
namespace {

// Under-relaxation of the limit per augmentation: `margin` reduces the normal force, `fall` is the
// fraction of its decrease since the last augmentation that is subtracted too [-].
struct LimitRelaxation {
  double margin, fall;
};
constexpr LimitRelaxation kLimitRelaxations[] = {{1e-3, 0.5}, {1e-3, 0.2}, {5e-3, 0.5}, {5e-2, 1.0},
                                                 {0.2, 1.0},  {0.5, 1.0},  {1.0, 1.0}};
// Stiffness of friction springs over that of contact [-]: stiff against tissue, but with fewer
// stick-slip transitions in a step than 1.
constexpr double kStiffnessRatio = 0.05;
// Largest sum of friction above its limit, over the sum of normal forces [-].
constexpr double kMaxExcessRatio = 1e-4;
constexpr double kRoundoff = 1e-13;

bool stateBefore(const FrictionState& a, const FrictionState& b) {
  return a.stick_point.before(b.stick_point);
}

bool isTight(const FrictionState& state) {
  return state.limit > 0.0 || state.stick_point.hold == Hold::kHeld;
}

}  // namespace

const FrictionState* FrictionStates::find(const Touch& touch) const {
  using Key = std::pair<int, int>;
  const auto key_of = [](const FrictionState& state) {
    return Key(state.stick_point.number, state.stick_point.sample);
  };
  const Key key(touch.number, touch.sample);
  const auto is_bound = [&](std::size_t k) {  // whether k is the lower bound of the key
    return k <= states_.size() && (k == states_.size() || key <= key_of(states_[k])) &&
           (k == 0 || key_of(states_[k - 1]) < key);
  };
  // Calls come in the order of touches, several for each.
  if (!is_bound(last_found_)) {
    if (is_bound(last_found_ + 1)) {
      ++last_found_;
    } else {
      const auto found =
          std::lower_bound(states_.begin(), states_.end(), key,
                           [&](const FrictionState& a, const Key& b) { return key_of(a) < b; });
      last_found_ = static_cast<std::size_t>(found - states_.begin());
    }
  }
  return last_found_ < states_.size() && key_of(states_[last_found_]) == key ? &states_[last_found_]
                                                                             : nullptr;
}

FrictionState* FrictionStates::findAmong(const Touch& touch) {
  return const_cast<FrictionState*>(find(touch));
}

bool FrictionStates::clings(const Touch& touch) const {
  if (const FrictionState* state = find(touch)) return isTight(*state);
  if (!states_.empty()) return false;
  const StickPoint* point = stick_points_.find(touch);  // at a step's begin
  return point && point->hold == Hold::kHeld;
}

bool FrictionStates::clings(int number, int first, int last) const {
  if (states_.empty()) return stick_points_.hold(number, first, last);
  FrictionState from;
  from.stick_point.number = number;
  from.stick_point.sample = first;
  for (auto state = std::lower_bound(states_.begin(), states_.end(), from, stateBefore);
       state != states_.end() && state->stick_point.number == number &&
       state->stick_point.sample <= last;
       ++state) {
    if (isTight(*state)) return true;
  }
  return false;
}

// Stiffness of the friction spring [N/m].
double FrictionStates::springOf(const Touch& touch) const {
  return kStiffnessRatio * touch.area * stiffness_;
}

Vec3 FrictionStates::stretch(const FrictionState& state, const Touch& touch) const {
  const Vec3 normal = touch.R_WG * state.normal_G;
  const Vec3 all = touch.R_WG * state.stick_point.stretch_G + touch.motion_W;
  return all - normal * normal.dot(all);
}

double FrictionStates::energy(const FrictionState& state, const Touch& touch) const {
  const double k = springOf(touch), d = stretch(state, touch).norm();
  if (state.stick_point.hold == Hold::kHeld) {
    return 0.5 * (k * d * d + tension(state, touch) * std::max(touch.gap, 0.0));
  }
  const double L = state.limit;
  return k * d <= L ? 0.5 * k * d * d : L * (d - 0.5 * L / k);
}

Vec3 FrictionStates::force(const FrictionState& state, const Touch& touch) const {
  const double k = springOf(touch);
  const Vec3 d = stretch(state, touch);
  const double length = d.norm();
  if (state.stick_point.hold == Hold::kHeld || k * length <= state.limit) return k * d;
  return state.limit / length * d;
}

double FrictionStates::tension(const FrictionState& state, const Touch& touch) const {
  if (state.stick_point.hold != Hold::kHeld) return 0.0;
  return touch.area * stiffness_ * std::max(touch.gap, 0.0);
}

Mat3 FrictionStates::stiffness(const FrictionState& state, const Touch& touch,
                               fem::Tangent tangent) const {
  const double k = springOf(touch);
  const Vec3 normal = touch.R_WG * state.normal_G;
  const Mat3 plane = Mat3::Identity() - normal * normal.transpose();
  if (state.stick_point.hold == Hold::kHeld) {
    Mat3 sum = k * plane;
    if (touch.gap > 0.0) {
      Mat3 H_G = touch.steepness * touch.steepness * touch.normal_G * touch.normal_G.transpose();
      if (tangent == fem::Tangent::kExact) H_G += touch.gap * touch.curvature_G;
      sum += touch.area * stiffness_ * touch.R_WG * H_G * touch.R_WG.transpose();
    }
    return sum;
  }
  if (state.limit == 0.0) return Mat3::Zero();
  const Vec3 d = stretch(state, touch);
  const double length = d.norm();
  if (k * length <= state.limit) return k * plane;
  const Vec3 along = d / length;
  return state.limit / length * (plane - along * along.transpose());
}

double FrictionStates::pressing(const Touch& touch) const {
  if (!(touch.gap < normal_.reach()) || !normal_.active(touch)) return 0.0;
  return std::max(-normal_.force(touch).normal, 0.0);
}

FrictionLimit FrictionStates::limit(const Touch& touch, double normal_force, bool slides) const {
  return limitOf(laws_, table_.of(touch.number), {normal_force, touch.area, slides});
}

// Traction up to which the touch's obstacle holds what it pressed [Pa].
double FrictionStates::holding(const Touch& touch) const {
  return holdingOf(laws_, table_.of(touch.number));
}

// Limit by the present normal force [N]; the touch's normal may differ from that of the slip plane.
double FrictionStates::allowed(const FrictionState& state, const Touch& touch) const {
  const FrictionLimit most = limit(touch, pressing(touch), state.stick_point.slides);
  const Vec3 d = stretch(state, touch);
  const double length = d.norm();
  double share = 1.0;
  if (length > 0.0) {
    const double off = touch.normal_W.dot(d) / length;
    share = std::max((d / length - off * touch.normal_W).norm() + most.slope * off, kRoundoff);
  }
  return most.force / share;
}

void FrictionStates::begin(const std::vector<Touch>& touches) {
  states_.clear();
  iteration_ = 0;
  for (const Touch& touch : touches) {
    if (touch.sample < 0 || !anyActs(laws_, table_.of(touch.number))) continue;
    // The normal force of the last step, since the normal response may have been updated since.
    const StickPoint* known = stick_points_.find(touch);
    const double N = known ? known->pressing : pressing(touch);
    if (!known && !(N > 0.0)) continue;
    FrictionState state;
    if (known) state.stick_point = *known;
    state.stick_point.number = touch.number;
    state.stick_point.sample = touch.sample;
    state.normal_G = touch.normal_G;
    state.begin = N;
    const double expected = std::clamp(N + state.stick_point.rise, 0.0, 2.0 * N);
    state.pressing = relaxed(expected, expected + std::abs(state.stick_point.rise));
    state.limit = limit(touch, state.pressing, state.stick_point.slides).force;
    states_.push_back(state);
  }
  std::sort(states_.begin(), states_.end(), stateBefore);
}

// Sums normal forces minus tension for each obstacle that holds.
void FrictionStates::sumPressing(const std::vector<Touch>& touches) {
  presses_.clear();
  for (const Touch& touch : touches) {
    if (!(holding(touch) > 0.0)) continue;
    const FrictionState* state = find(touch);
    const double N = pressing(touch) - (state ? tension(*state, touch) : 0.0);
    const auto sum = std::find_if(presses_.begin(), presses_.end(),
                                  [&](const auto& p) { return p.first == touch.number; });
    if (sum != presses_.end()) {
      sum->second += N;
    } else {
      presses_.emplace_back(touch.number, N);
    }
  }
}

bool FrictionStates::presses(int number) const {
  return std::any_of(presses_.begin(), presses_.end(),
                     [&](const auto& p) { return p.first == number && p.second > 0.0; });
}

double FrictionStates::relaxed(double N, double before) const {
  const LimitRelaxation& c =
      kLimitRelaxations[std::min<std::size_t>(iteration_, std::size(kLimitRelaxations) - 1)];
  return (1.0 - c.margin) * std::max(N - c.fall * std::max(before - N, 0.0), 0.0);
}

// Whether a held touch is released; `change`: also updates the state.
bool FrictionStates::releases(const Touch& touch, bool change, FrictionState* state) const {
  if (state->stick_point.hold != Hold::kHeld) return false;
  const double drawn = std::hypot(force(*state, touch).norm(), tension(*state, touch));
  const bool torn = drawn > holding(touch) * touch.area;
  if (!torn && presses(touch.number)) return false;
  if (change) state->stick_point.hold = torn ? Hold::kTorn : Hold::kNone;
  return true;
}

// Whether the touch needs an augmentation; `change`: also updates the state.
bool FrictionStates::reviewOne(const Touch& touch, bool change, FrictionState* state) {
  const bool freed = releases(touch, change, state);
  if (state->stick_point.hold == Hold::kHeld) return freed;
  const double drawn = springOf(touch) * stretch(*state, touch).norm();
  const bool slips = !state->stick_point.slides && drawn > state->limit;
  if (slips && change) state->stick_point.slides = true;
  const double N = pressing(touch);
  pressing_ += N;
  excess_ += std::max(std::min(drawn, state->limit) - allowed(*state, touch), 0.0);
  if (change) {
    const double next = relaxed(N, state->pressing);
    state->pressing = iteration_ == 1 ? next : std::min(state->pressing, next);
    state->limit = limit(touch, state->pressing, state->stick_point.slides).force;
    state->normal_G = touch.normal_G;
  }
  return freed || (slips && anyWeakens(laws_, table_.of(touch.number)));
}

bool FrictionStates::review(const std::vector<Touch>& touches, bool change) {
  if (states_.empty()) return false;
  sumPressing(touches);
  if (change) ++iteration_;
  bool any = false;
  pressing_ = excess_ = 0.0;
  for (const Touch& touch : touches) {
    if (FrictionState* state = findAmong(touch)) any |= reviewOne(touch, change, state);
  }
  return any || excess_ > kMaxExcessRatio * pressing_;
}

void FrictionStates::confine(const std::vector<Touch>& touches) {
  for (const Touch& touch : touches) {
    if (FrictionState* state = findAmong(touch)) {
      state->limit = std::min(state->limit, allowed(*state, touch));
    }
  }
}

// Makes stick points of all touches that are pressed or held.
void FrictionStates::end(const std::vector<Touch>& touches) {
  sumPressing(touches);
  next_.clear();
  for (const Touch& touch : touches) {
    if (touch.sample < 0 || !anyActs(laws_, table_.of(touch.number))) continue;
    FrictionState* state = findAmong(touch);
    if (state) releases(touch, true, state);
    const bool held = state && state->stick_point.hold == Hold::kHeld;
    const double N = pressing(touch);
    if (!held && !(N > 0.0)) continue;
    StickPoint point;
    if (state) {
      const double k = springOf(touch);
      point = state->stick_point;
      point.rise = N - state->begin;
      point.stretch_G = touch.R_WG.transpose() * force(*state, touch) / k;
      point.slides = !held && k * stretch(*state, touch).norm() >= state->limit;
    }
    point.number = touch.number;
    point.sample = touch.sample;
    point.pressing = N;
    const bool can_hold = holding(touch) > 0.0 && point.hold == Hold::kNone;
    if (can_hold && N > 0.0 && presses(touch.number)) point.hold = Hold::kHeld;
    next_.push_back(point);
  }
  stick_points_.take(next_);
  states_.clear();
}

void FrictionStates::goOnFrom(const FrictionStates& old, const std::function<int(int)>& now) {
  stick_points_.goOnFrom(old.stick_points_, now);
  states_.clear();
}

void FrictionStates::forget() {
  stick_points_.clear();
  states_.clear();
}

void FrictionStates::restore(StateReader* from) {
  stick_points_.restore(from);
  states_.clear();
}

}  // namespace palpate::contact
