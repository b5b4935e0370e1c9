// SPDX-License-Identifier: GPL-3.0-or-later
#include "friction_response.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "friction_state.h"

namespace palpate::contact {
namespace {

// Largest gap of a held touch within reach, in smoothing widths [-].
constexpr double kReach = 10.0;

class FrictionResponse final : public Response {
 public:
  FrictionResponse(std::unique_ptr<Response> normal, const ResponseSettings& settings,
                   const FrictionList& laws)
      : normal_(std::move(normal)),
        laws_(laws),
        table_(settings.friction_with),
        reach_(std::max(kReach * settings.smoothing,
                        2.0 * strongestHolding(laws, settings.friction_with) / settings.stiffness)),
        states_(normal_.get(), &laws_, &table_, settings.stiffness) {}

  double reach() const override { return normal_->reach() + reach_; }
  bool clings(int number, int first, int last) const override {
    return states_.clings(number, first, last);
  }
  bool active(const Touch& touch) const override { return pressed(touch) || states_.clings(touch); }
  bool followsMotion() const override { return true; }
  bool hasFriction() const override { return true; }
  bool rubs(const Touch& touch) const override {
    return touch.sample >= 0 && anyActs(laws_, table_.of(touch.number));
  }

  double energy(const Touch& touch) const override {
    const double own = pressed(touch) ? normal_->energy(touch) : 0.0;
    const FrictionState* state = states_.find(touch);
    return state ? own + states_.energy(*state, touch) : own;
  }
  TouchForce force(const Touch& touch) const override {
    TouchForce sum;
    if (pressed(touch)) sum = normal_->force(touch);
    if (const FrictionState* state = states_.find(touch)) {
      sum.normal += states_.tension(*state, touch) * touch.steepness;
      sum.other_W += states_.force(*state, touch);
    }
    return sum;
  }
  Mat3 stiffness(const Touch& touch, fem::Tangent tangent) const override {
    Mat3 sum = Mat3::Zero();
    if (pressed(touch)) sum = normal_->stiffness(touch, tangent);
    if (const FrictionState* state = states_.find(touch))
      sum += states_.stiffness(*state, touch, tangent);
    return sum;
  }

  bool remembers() const override { return true; }
  void beginStep(const std::vector<Touch>& touches) override {
    if (normal_->remembers()) normal_->beginStep(touches);
    states_.begin(touches);
  }
  void endStep(const std::vector<Touch>& touches) override {
    if (normal_->remembers()) normal_->endStep(touches);
    states_.end(touches);
  }
  bool augmentationConverged(const std::vector<Touch>& touches) override {
    return states_.augmentationConverged(touches);
  }
  void augment(const std::vector<Touch>& touches) override { states_.augment(touches); }
  void learn(const std::vector<Touch>& touches) override {
    if (normal_->remembers()) normal_->learn(touches);
  }
  void confine(const std::vector<Touch>& touches) override { states_.confine(touches); }

  void goOnFrom(const Response& old, const SurfaceMap& now) override {
    const auto& other = dynamic_cast<const FrictionResponse&>(old);
    if (normal_->remembers()) normal_->goOnFrom(*other.normal_, now);
    states_.goOnFrom(other.states_, now.sample);
  }
  void forget() override {
    normal_->forget();
    states_.forget();
  }
  void save(StateWriter* to) const override {
    if (normal_->remembers()) normal_->save(to);
    states_.save(to);
  }
  void restore(StateReader* from) override {
    if (normal_->remembers()) normal_->restore(from);
    states_.restore(from);
  }

 private:
  bool pressed(const Touch& touch) const {
    return touch.gap < normal_->reach() && normal_->active(touch);
  }

  std::unique_ptr<Response> normal_;
  const FrictionList& laws_;
  FrictionTable table_;
  double reach_;
  FrictionStates states_;
};

}  // namespace

std::unique_ptr<Response> withFriction(std::unique_ptr<Response> normal,
                                       const ResponseSettings& settings, const FrictionList& laws) {
  return std::make_unique<FrictionResponse>(std::move(normal), settings, laws);
}

}  // namespace palpate::contact
