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

/// Force of the tissue on the obstacle: gradient of the touch's energy by p_W.
struct TouchForce {
  double normal = 0.0;          ///< Along Touch::normal_W; negative where the tissue pushes [N].
  Vec3 other_W = Vec3::Zero();  ///< The rest of the force, such as friction [N].
};

/// A contact law: the energy of a Touch as a function of the sample's position and of the
/// response's state. Derivatives are by Touch::p_W, in world.
class Response {
 public:
  virtual ~Response() = default;

  /// Largest gap at which a touch has energy [m]; touches that cling are exempt.
  virtual double reach() const { return 0.0; }
  /// Whether a sample in [first, last] sticks to obstacle `number`, and has energy at any gap.
  virtual bool clings(int /*number*/, int /*first*/, int /*last*/) const { return false; }
  /// Whether a touch within reach may have energy; only the gap is measured.
  /// Conservative: false means zero energy.
  virtual bool active(const Touch& /*touch*/) const { return true; }
  /// Whether the energy depends on Touch::motion_W; it is measured then, for energy() with the
  /// frame.
  virtual bool followsMotion() const { return false; }

  /// [J]
  virtual double energy(const Touch& touch) const = 0;
  virtual TouchForce force(const Touch& touch) const = 0;
  /// Second derivative of the energy [N/m]; unless kExact, a positive semidefinite part.
  virtual Mat3 stiffness(const Touch& touch, fem::Tangent tangent) const = 0;
  /// The positive semidefinite part, from the exact stiffness [N/m] and the force [N].
  virtual Mat3 convexStiffness(const Touch& touch, const Mat3& /*exact*/,
                               const Vec3& /*force_W*/) const {
    return stiffness(touch, fem::Tangent::kConvexTerms);
  }

  /// Whether tangential forces are bounded by normal forces.
  virtual bool hasFriction() const { return false; }
  /// Whether friction is evaluated for this touch.
  virtual bool rubs(const Touch& /*touch*/) const { return false; }
  /// Limits friction by the normal forces of these touches, at the final solution of a step.
  virtual void confine(const std::vector<Touch>& /*touches*/) {}

  // For responses with state: remembers() is true. Others need not override these.
  virtual bool remembers() const { return false; }
  /// A step begins, or has ended, with these active touches, in a fixed order.
  virtual void beginStep(const std::vector<Touch>& /*touches*/) {}
  virtual void endStep(const std::vector<Touch>& /*touches*/) {}
  /// Whether the solution of the step with these touches needs no further augmentation.
  virtual bool augmentationConverged(const std::vector<Touch>& /*touches*/) { return true; }
  /// Updates multipliers or friction limits by these touches; the step is then solved again.
  virtual void augment(const std::vector<Touch>& /*touches*/) {}
  /// Updates the state for the next step from the touches at the end of a step.
  virtual void learn(const std::vector<Touch>& /*touches*/) {}
  /// Map from an old surface of a body to its present surface.
  struct SurfaceMap {
    struct Node {
      int node;             ///< Index on the present surface.
      Eigen::Vector3i old;  ///< Corners of the old triangle with that node.
      Vec3 weights;         ///< Barycentric coordinates of the node in the old triangle.
    };
    std::function<int(int)> sample;  ///< Index of an old sample on the present surface; -1: none.
    std::vector<Node> nodes;         ///< Nodes in the old contact region, ascending.
  };
  /// Takes over the state of `old`, a response of the same name on another surface of the body.
  virtual void goOnFrom(const Response& /*old*/, const SurfaceMap& /*now*/) {}
  /// Clears the state: nothing has touched yet.
  virtual void forget() {}
  /// Writes the whole state; called between steps.
  virtual void save(StateWriter* /*to*/) const {}
  /// @throws std::invalid_argument as StateReader does.
  virtual void restore(StateReader* /*from*/) {}
};

struct ResponseEntry {
  std::string name;
  std::unique_ptr<Response> (*make)(const ResponseSettings&);
};

/// All responses; the first is the default.
const std::vector<ResponseEntry>& responses();
std::vector<std::string> responseNames();

/// Makes the response that `settings.model` names in `table`, with the friction of the settings.
/// @throws std::invalid_argument for a name that `table` does not have.
std::unique_ptr<Response> makeResponse(const ResponseSettings& settings,
                                       const std::vector<ResponseEntry>& table = responses());

}  // namespace palpate::contact
