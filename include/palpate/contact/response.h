// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/contact/response_settings.h"
#include "palpate/contact/touch.h"
#include "palpate/fem/elasticity.h"

namespace palpate::contact {

/// What the tissue does to the obstacle in a touch: the gradient of the touch's energy.
struct TouchForce {
  double normal = 0.0;          ///< Along Touch::normal_W; negative where the tissue pushes [N].
  Vec3 other_W = Vec3::Zero();  ///< All beside it, such as friction [N].
};

/// What answers touches: an energy of each, by the sample's position p and, where there is a
/// memory, by what went before. Derivatives are by p_W, in world.
class Response {
 public:
  virtual ~Response() = default;

  /// No touch answers whose gap is as large as this or larger [m], but for those that cling.
  virtual double reach() const { return 0.0; }
  /// Whether one of the samples [first, last] clings to an obstacle, and answers wherever it is.
  virtual bool clings(int /*number*/, int /*first*/, int /*last*/) const { return false; }
  /// Whether a touch within reach, of which only the gap is measured, may answer. One that does not
  /// is skipped: its energy is zero whatever else is known of it.
  virtual bool active(const Touch& /*touch*/) const { return true; }
  /// Whether the answer depends on more than gap and frame: energy() then gets the frame, too, and
  /// all of them Touch::motion_W.
  virtual bool followsMotion() const { return false; }

  /// [J]
  virtual double energy(const Touch& touch) const = 0;
  virtual TouchForce force(const Touch& touch) const = 0;
  /// Second derivative of the energy [N/m]; a positive semidefinite part of it but for kExact.
  virtual Mat3 stiffness(const Touch& touch, fem::Tangent tangent) const = 0;
  /// The positive semidefinite part, for who has the exact stiffness and the force at hand.
  virtual Mat3 convexStiffness(const Touch& touch, const Mat3& /*exact*/,
                               const Vec3& /*force_W*/) const {
    return stiffness(touch, fem::Tangent::kConvexTerms);
  }

  /// Whether forces beside the normal are bounded by what presses.
  virtual bool hasFriction() const { return false; }
  /// Whether friction is evaluated for this touch.
  virtual bool rubs(const Touch& /*touch*/) const { return false; }
  /// No more friction than the forces of these touches allow, at a solution that stays.
  virtual void confine(const std::vector<Touch>& /*touches*/) {}

  // Of a response with a memory; the others are not asked.
  virtual bool remembers() const { return false; }
  /// A step begins or has ended with these touches, those that answer, in a fixed order.
  virtual void beginStep(const std::vector<Touch>& /*touches*/) {}
  virtual void endStep(const std::vector<Touch>& /*touches*/) {}
  /// Whether these touches, at a solution within the step, are what they are to be in the end.
  virtual bool augmentationConverged(const std::vector<Touch>& /*touches*/) { return true; }
  /// Changes what is not; the solution is then another one, nearer to that.
  virtual void augment(const std::vector<Touch>& /*touches*/) {}
  /// Learns from the touches with which a step has ended, for the next one.
  virtual void learn(const std::vector<Touch>& /*touches*/) {}
  /// How another surface's places are found on this one.
  struct SurfaceMap {
    struct Node {
      int node;             ///< Of this one
      Eigen::Vector3i old;  ///< lies on that triangle of the other,
      Vec3 weights;         ///< with these barycentric coordinates.
    };
    std::function<int(int)> sample;  ///< Of that one: which of this; -1: there is none.
    std::vector<Node> nodes;         ///< Where it was touched, ascending.
  };
  /// Takes over what `old`, of the same name, remembers of another surface of the same body.
  virtual void goOnFrom(const Response& /*old*/, const Places& /*now*/) {}
  /// As new: nothing has touched yet.
  virtual void forget() {}
  /// All that is needed to go on, between steps.
  virtual void save(StateWriter* /*to*/) const {}
  /// @throws std::invalid_argument as StateReader does.
  virtual void restore(StateReader* /*from*/) {}
};

struct ResponseEntry {
  std::string name;
  std::unique_ptr<Response> (*make)(const ResponseSettings&);
};

/// The responses that there are; the first is the default.
const std::vector<ResponseEntry>& responses();
std::vector<std::string> responseNames();

/// The entry of `table` that `settings.model` names, with friction where the settings have some.
/// @throws std::invalid_argument for a name that is not in it.
std::unique_ptr<Response> makeResponse(const ResponseSettings& settings,
                                       const std::vector<ResponseEntry>& table = responses());

}  // namespace palpate::contact
