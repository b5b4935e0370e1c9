// SPDX-License-Identifier: GPL-3.0-or-later
#include "neural_organ.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace palpate::tissue {
namespace {

constexpr double kBegin = 0.8;   // strangeness at which elements begin [-]
constexpr double kEnd = 0.7;     // strangeness at which they end [-]
constexpr double kWidest = 1.5;  // largest ratio of a ball's force to the patch's [-]
constexpr int kUntold = 2;       // cycles in which a sudden start decays
constexpr double kCalm = 1e-3;   // distance from rest that counts as rest, over the body's size [-]
constexpr double kClear = 1e-3;  // distance of a withdrawn tool, over the body's size [-]

}  // namespace

NeuralOrgan::NeuralOrgan(NeuralParts parts, const NeuralSettings& neural,
                         const ModelSettings& settings)
    : elements_(std::move(parts.elements)),
      surrogate_(std::move(parts.surrogate)),
      X_O_(parts.body.points),
      X_(elements_->positions()),
      triangles_(elements_->surfaceState(0).triangles),
      R_WO_(parts.X_WO.linear()),
      switch_time_(neural.switch_time),
      size_((X_.rowwise().maxCoeff() - X_.rowwise().minCoeff()).norm()),
      may_sleep_(settings.skip.sleeping),
      learned_shape_(surrogate_, parts.body, triangles_, parts.free, R_WO_),
      finder_(X_, triangles_) {
  const TissueStep& alone = elements_->step({}, 0.01);
  gravity_force_ = alone.gravity_force;
  tolerance_ = alone.tolerance;
  coefficients_.setZero(surrogate_.numModes());
  still_.setZero(3, X_.cols());
  NeuralOrgan::reset();
}

std::vector<std::string> NeuralOrgan::notes() const {
  std::ostringstream text;
  text.precision(2);
  text << "model neural: "
       << (std::holds_alternative<enrichment::KernelMap>(surrogate_.map) ? "kernels" : "a network")
       << " of " << surrogate_.numParameters() << " parameters, " << surrogate_.numModes()
       << " modes; quasi-static, and only tools and anatomy touch it; what it has not learned is "
          "solved by finite elements. It learned of "
       << surrogate_.made_by;
  std::vector<std::string> all = elements_->notes();
  all.insert(all.begin(), text.str());
  return all;
}

const TissueStep& NeuralOrgan::step(const std::vector<contact::Obstacle>& obstacles, double dt) {
  x_begin_ = x_;
  out_.clear();
  const bool untouched = followed_ < 0;
  findPresses(obstacles);
  const double strangeness = answer();
  const double wanted = wantedPart(strangeness);
  const bool begins = !solving_ && wanted > 0.0;
  // No result was reported yet, so no blend is needed.
  const bool at_once = begins && untouched;
  if (begins) {
    elements_->setPositions(0, X_, still_);  // as reset(), but keeps solver state
    if (!at_once) drawOut(obstacles);
    solving_ = true;
    begun_ = at_once ? 0 : kUntold;
    if (at_once) part_ = wanted;
  }
  if (solving_ && !stepElements(begins && !at_once ? ways_ : obstacles, dt)) return out_;
  approach(wanted, strangeness, dt);
  report(obstacles, dt);
  return out_;
}

void NeuralOrgan::findPresses(const std::vector<contact::Obstacle>& obstacles) {
  presses_.clear();
  for (const contact::Obstacle& obstacle : obstacles) presses_.push_back(finder_.find(obstacle));
  const auto touches = [&](int k) { return presses_[static_cast<std::size_t>(k)].depth > 0.0; };
  const int number = static_cast<int>(obstacles.size());
  if (followed_ >= 0 && followed_ < number && touches(followed_)) return;
  followed_ = -1;
  double deepest = 0.0;
  for (int k = 0; k < number; ++k) {
    const double depth = presses_[static_cast<std::size_t>(k)].depth;
    if (!obstacles[static_cast<std::size_t>(k)].owner.isInstrument() || depth <= deepest) continue;
    deepest = depth;
    followed_ = k;
  }
}

// Evaluates the surrogate. Returns the strangeness of the press.
double NeuralOrgan::answer() {
  force_.setZero();
  coefficients_.setZero();
  if (followed_ < 0) return 0.0;
  const ToolPress& press = presses_[static_cast<std::size_t>(followed_)];
  Vec3 place = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    place += press.weights[k] * X_O_.col(triangles_(k, press.triangle));
  }
  const Vec3 displacement = R_WO_.transpose() * press.displacement();
  Vec3 force_O;
  surrogate_.predict(place, displacement, &work_, &force_O, &coefficients_);
  const double width =
      32.0 / (9.0 * std::acos(-1.0) * surrogate_.patch) * std::sqrt(press.radius * press.depth);
  const double ratio = press.radius > 0.0 ? std::min(width, kWidest) : 1.0;
  // Forces never pull.
  force_ = ratio * std::max(0.0, press.normal_W.dot(R_WO_ * force_O)) * press.normal_W;
  if (press.radius <= 0.0) return 2.0;
  return std::max(surrogate_.strangeness(place, displacement), width / kWidest);
}

// Final weight of the elements.
double NeuralOrgan::wantedPart(double strangeness) const {
  int touching = 0;
  for (const ToolPress& press : presses_) touching += press.depth > 0.0;
  if (touching == 0) return solving_ && !isCalm() ? part_ : 0.0;
  if (touching > 1 || followed_ < 0) return 1.0;
  return std::clamp((strangeness - kBegin) / (1.0 - kBegin), 0.0, 1.0);
}

// Whether the elements are at rest without contact.
bool NeuralOrgan::isCalm() const {
  return (elements_->positions() - X_).cwiseAbs().maxCoeff() <= kCalm * size_;
}

// Makes tool paths that begin outside of the body.
void NeuralOrgan::drawOut(const std::vector<contact::Obstacle>& obstacles) {
  ways_.clear();
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    ways_.push_back(obstacles[k]);
    const ToolPress& press = presses_[k];
    if (press.depth <= 0.0 || !obstacles[k].owner.isInstrument()) continue;
    ways_.back().X_WG_begin = ways_.back().X_WG_end;
    ways_.back().X_WG_begin.pretranslate(-(press.depth + kClear * size_) * press.normal_W);
  }
}

// Steps the elements. Returns false on failure, without motion.
bool NeuralOrgan::stepElements(const std::vector<contact::Obstacle>& obstacles, double dt) {
  out_ = elements_->step(obstacles, dt);
  out_.slept = false;
  if (solver::usable(out_.status)) return true;
  out_.contacts.clear();
  v_.setZero();
  return false;
}

void NeuralOrgan::approach(double wanted, double strangeness, double dt) {
  if (!solving_) return;
  if (begun_ > 0) {
    --begun_;
    return;
  }
  const double most = dt / switch_time_;
  part_ += std::clamp(wanted - part_, -most, most);
  if (wanted == 0.0 && part_ == 0.0 && strangeness < kEnd) solving_ = false;
}

void NeuralOrgan::report(const std::vector<contact::Obstacle>& obstacles, double dt) {
  const double learned = 1.0 - part_;
  x_ = X_;
  if (followed_ >= 0) learned_shape_.displace(coefficients_, &x_);
  if (part_ > 0.0) x_ = learned * x_ + part_ * elements_->positions();
  v_ = (x_ - x_begin_) / dt;
  for (TissueContact& contact : out_.contacts) contact.force_W *= part_;
  if (part_ == 0.0) out_.contacts.clear();
  if (followed_ >= 0 && learned > 0.0) {
    const auto k = static_cast<std::size_t>(followed_);
    out_.contacts.push_back({obstacles[k].owner, 0.0, presses_[k].p_W, -learned * force_, 0});
  }
  // Quasi-static: supports balance tools and gravity.
  out_.support_force = part_ * out_.support_force - learned * (force_ + gravity_force_);
  out_.gravity_force = gravity_force_;
  out_.inertia_force *= part_;
  out_.interaction_force *= part_;
  if (solving_) return;
  out_.residual = 0.0;  // elements without weight do not count
  out_.tolerance = tolerance_;
  out_.satisfied = true;
  out_.slept = may_sleep_ && followed_ < 0;
}

void NeuralOrgan::reset() {
  elements_->reset();
  part_ = 0.0;
  solving_ = false;
  begun_ = 0;
  followed_ = -1;
  x_ = X_;
  v_.setZero(3, x_.cols());
}

// Sets the elements' positions and velocities.
void NeuralOrgan::setPositions(int, const Points& positions, const Points& velocities) {
  elements_->setPositions(0, positions, velocities);
  part_ = 1.0;
  solving_ = true;
  begun_ = 0;
  followed_ = -1;
  x_ = positions;
  v_ = velocities;
}

std::string NeuralOrgan::kind() const {
  return "neural, " + std::to_string(x_.cols()) + " points, " +
         std::to_string(surrogate_.numParameters()) + " parameters";
}

State NeuralOrgan::state() const {
  StateWriter out;
  out.put(x_);
  out.put(v_);
  out.put(part_);
  out.put(solving_);
  out.put(begun_);
  out.put(followed_);
  if (solving_) {
    const State elements = elements_->state();
    out.put(std::string_view(elements.kind));
    out.put(std::string_view(elements.bytes));
  }
  return {kind(), out.bytes()};
}

void NeuralOrgan::restore(const State& state) {
  checkKind(state, kind());
  StateReader in(state.bytes);
  in.getSame(&x_);
  in.getSame(&v_);
  in.get(&part_);
  in.get(&solving_);
  in.get(&begun_);
  in.get(&followed_);
  if (solving_) {
    State elements;
    in.get(&elements.kind);
    in.get(&elements.bytes);
    elements_->restore(elements);
  }
  in.finish();
}

}  // namespace palpate::tissue
