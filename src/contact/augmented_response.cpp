// SPDX-License-Identifier: GPL-3.0-or-later
#include "augmented_response.h"

#include <algorithm>
#include <cmath>

#include "multipliers.h"
#include "palpate/contact/penalty.h"

namespace palpate::contact {
namespace {

// Upper bound of a multiplier [Pa], for contact with held tissue.
constexpr double kMaxMultiplier = 1e7;
// Least penalty stiffness over Young's modulus per edge length [-].
constexpr double kMinStiffnessRatio = 300.0;
// Mass that moves with a surface node, over the node's mass [-].
constexpr double kEntrainedMassRatio = 30.0;
// See makeAugmentedResponse() [m].
constexpr double kGrowthTravel = 0.5e-3, kDecaySlip = 0.3e-3;

class AugmentedResponse final : public Response {
 public:
  explicit AugmentedResponse(const ResponseSettings& settings)
      : law_{settings.stiffness, settings.smoothing},
        of_balls_{std::min(settings.stiffness, Penalty().stiffness), settings.smoothing} {}

  double reach() const override {
    return multipliers_.largest() > 0.0 ? law_.softPenetration(multipliers_.largest()) : 0.0;
  }
  bool active(const Touch& touch) const override {
    return touch.gap < 0.0 || Law(this, touch).presses();
  }

  double energy(const Touch& touch) const override {
    return touch.area * Law(this, touch).energy();
  }
  TouchForce force(const Touch& touch) const override {
    return {-touch.area * Law(this, touch).pressure() * touch.steepness, Vec3::Zero()};
  }
  Mat3 stiffness(const Touch& touch, fem::Tangent tangent) const override {
    const Law law(this, touch);
    const double along = law.slope() * touch.steepness * touch.steepness;
    Mat3 H_G = along * touch.normal_G * touch.normal_G.transpose();
    if (tangent == fem::Tangent::kExact) H_G -= law.pressure() * touch.curvature_G;
    return touch.area * touch.R_WG * H_G * touch.R_WG.transpose();
  }
  Mat3 convexStiffness(const Touch& touch, const Mat3& exact, const Vec3& force_W) const override {
    if (touch.steepness != 1.0) return stiffness(touch, fem::Tangent::kConvexTerms);
    const Vec3 n = force_W.stableNormalized();
    return n.dot(exact * n) * n * n.transpose();
  }

  bool remembers() const override { return true; }
  void learn(const std::vector<Touch>& touches) override { multipliers_.change(touches, target_); }
  void goOnFrom(const Response& old, const SurfaceMap& now) override {
    multipliers_.goOnFrom(dynamic_cast<const AugmentedResponse&>(old).multipliers_, now);
  }
  void forget() override { multipliers_.clear(); }
  void save(StateWriter* to) const override { multipliers_.save(to); }
  void restore(StateReader* from) override { multipliers_.restore(from); }

 private:
  // Of one touch.
  class Law {
   public:
    Law(const AugmentedResponse* of, const Touch& touch)
        : penalty_(touch.sample < 0 ? of->of_balls_ : of->law_),
          depth_(touch.penetration()),
          room_(touch.room) {
      penalty_.stiffness = std::max(penalty_.stiffness, kMinStiffnessRatio * touch.bearing);
      // Balls have no multiplier: weights of the nodes change as the triangle moves.
      const double multiplier = touch.sample < 0 ? 0.0 : of->multipliers_.at(touch);
      if (multiplier > 0.0) shift_ = penalty_.softPenetration(multiplier);
    }
    bool presses() const { return depth_ + shift_ > 0.0; }
    double energy() const {
      return penalty_.softEnergy(depth_ + shift_) + penalty_.hardEnergy(depth_, room_);
    }
    double pressure() const {
      return penalty_.softPressure(depth_ + shift_) + penalty_.hardPressure(depth_, room_);
    }
    double slope() const {
      return penalty_.softSlope(depth_ + shift_) + penalty_.hardSlope(depth_, room_);
    }

   private:
    Penalty penalty_;
    double depth_, room_, shift_ = 0.0;
  };

  Penalty law_, of_balls_;
  Multipliers multipliers_;
  const Multipliers::TargetOf target_ =
      [this](const Touch& touch) -> Multipliers::MultiplierTarget {
    if (touch.sample < 0) return {0.0, 0.0, 0.0, 0.0, 0.0};
    const Law law(this, touch);
    const double slip = touch.slipInWorld().norm() / kDecaySlip;
    return {std::min(law.pressure(), kMaxMultiplier), touch.area * law.slope(),
            kEntrainedMassRatio * touch.inertia, std::exp(-touch.travel / kGrowthTravel),
            -std::expm1(-slip * slip)};
  };
};

}  // namespace

std::unique_ptr<Response> makeAugmentedResponse(const ResponseSettings& settings) {
  return std::make_unique<AugmentedResponse>(settings);
}

}  // namespace palpate::contact
