// SPDX-License-Identifier: GPL-3.0-or-later
#include "penalty_response.h"

#include "palpate/contact/penalty.h"

namespace palpate::contact {
namespace {

class PenaltyResponse final : public Response {
 public:
  explicit PenaltyResponse(const Penalty& law) : law_(law) {}

  double energy(const Touch& touch) const override {
    return touch.area * law_.energy(touch.penetration(), touch.room);
  }
  TouchForce force(const Touch& touch) const override {
    const double pressure = law_.pressure(touch.penetration(), touch.room);
    return {-touch.area * pressure * touch.steepness, Vec3::Zero()};
  }
  /// The shape's curvature is the only part that is not semidefinite.
  Mat3 stiffness(const Touch& touch, fem::Tangent tangent) const override {
    const double p = touch.penetration();
    const double along = law_.slope(p, touch.room) * touch.steepness * touch.steepness;
    Mat3 H_G = along * touch.normal_G * touch.normal_G.transpose();
    if (tangent == fem::Tangent::kExact) H_G -= law_.pressure(p, touch.room) * touch.curvature_G;
    return touch.area * touch.R_WG * H_G * touch.R_WG.transpose();
  }
  /// The same along the force: but for the last bit, which tled and linear_precomputed keep. Not
  /// where the gradient's length changes, whose curvature is along the force as well.
  Mat3 convexStiffness(const Touch& touch, const Mat3& exact, const Vec3& force_W) const override {
    if (touch.steepness != 1.0) return stiffness(touch, fem::Tangent::kConvexTerms);
    const Vec3 n = force_W.stableNormalized();
    return n.dot(exact * n) * n * n.transpose();
  }

 private:
  Penalty law_;
};

}  // namespace

std::unique_ptr<Response> makePenaltyResponse(const ResponseSettings& settings) {
  return std::make_unique<PenaltyResponse>(Penalty{settings.stiffness, settings.smoothing});
}

}  // namespace palpate::contact
