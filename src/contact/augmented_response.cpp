// SPDX-License-Identifier: GPL-3.0-or-later
#include "augmented_response.h"

#include <algorithm>

#include "nodal_shift.h"
#include "palpate/contact/penalty.h"

namespace palpate::contact {
namespace {

// Where rigid things meet, the multiplier grows no further [Pa].
constexpr double kHighestPressure = 1e7;

class AugmentedResponse final : public Response {
 public:
  explicit AugmentedResponse(const ResponseSettings& settings)
      : law_{settings.stiffness, settings.smoothing},
        of_balls_{std::min(settings.stiffness, Penalty().stiffness), settings.smoothing},
        allowed_(settings.allowed_penetration) {}

  double reach() const override { return shift_.largest(); }
  bool active(const Touch& touch) const override { return touch.gap < shift(touch); }

  double energy(const Touch& touch) const override {
    const double p = touch.penetration();
    return touch.area *
           (law(touch).softEnergy(p + shift(touch)) + law(touch).hardEnergy(p, touch.room));
  }
  TouchForce force(const Touch& touch) const override {
    return {-touch.area * pressure(touch) * touch.steepness, Vec3::Zero()};
  }
  Mat3 stiffness(const Touch& touch, fem::Tangent tangent) const override {
    const double along = slope(touch) * touch.steepness * touch.steepness;
    Mat3 H_G = along * touch.normal_G * touch.normal_G.transpose();
    if (tangent == fem::Tangent::kExact) H_G -= pressure(touch) * touch.curvature_G;
    return touch.area * touch.R_WG * H_G * touch.R_WG.transpose();
  }
  Mat3 convexStiffness(const Touch& touch, const Mat3& exact, const Vec3& force_W) const override {
    if (touch.steepness != 1.0) return stiffness(touch, fem::Tangent::kConvexTerms);
    const Vec3 n = force_W.stableNormalized();
    return n.dot(exact * n) * n * n.transpose();
  }

  bool remembers() const override { return true; }
  bool settled(const std::vector<Touch>& touches) override {
    return shift_.largestChange(touches, wish_) <= allowed_;
  }
  void settle(const std::vector<Touch>& touches) override { shift_.change(touches, wish_); }
  void goOnFrom(const Response& old, const Places& now) override {
    shift_.goOnFrom(dynamic_cast<const AugmentedResponse&>(old).shift_, now.node);
  }
  void forget() override { shift_.clear(); }
  void save(StateWriter* to) const override { shift_.save(to); }
  void restore(StateReader* from) override { shift_.restore(from); }

 private:
  double pressure(const Touch& touch) const {
    const double p = touch.penetration();
    return law(touch).softPressure(p + shift(touch)) + law(touch).hardPressure(p, touch.room);
  }
  double slope(const Touch& touch) const {
    const double p = touch.penetration();
    return law(touch).softSlope(p + shift(touch)) + law(touch).hardSlope(p, touch.room);
  }

  // None where a ball meets a triangle: there the nodes' parts change as the triangle moves.
  double shift(const Touch& touch) const { return touch.sample < 0 ? 0.0 : shift_.at(touch); }

  // It has a penalty instead, whose stiffness is none to choose.
  const Penalty& law(const Touch& touch) const { return touch.sample < 0 ? of_balls_ : law_; }

  Penalty law_, of_balls_;
  double allowed_;
  NodalShift shift_;
  const NodalShift::WishOf wish_ = [this](const Touch& touch) -> NodalShift::Wish {
    if (touch.sample < 0) return {0.0, 0.0, 0.0};
    const double needed = law_.softPenetration(std::min(pressure(touch), kHighestPressure));
    return {needed - shift(touch), touch.area * slope(touch), touch.inertia};
  };
};

}  // namespace

std::unique_ptr<Response> makeAugmentedResponse(const ResponseSettings& settings) {
  return std::make_unique<AugmentedResponse>(settings);
}

}  // namespace palpate::contact
