// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/contact/friction.h"

namespace palpate::contact {

/// Load of a touch, by which a friction law limits its friction force.
struct FrictionLoad {
  double normal_force;  ///< [N], >= 0.
  double area;          ///< Rest area of the sample [m^2].
  bool slides;          ///< Whether the touch slipped since it last stuck.
};

/// Limit of a touch's friction force.
struct FrictionLimit {
  double force = 0.0;  ///< [N], >= 0.
  double slope = 0.0;  ///< Derivative of `force` by the normal force [-], >= 0.
};

/// A friction law: how large the friction force of a touch may be. FrictionStates has the spring,
/// the stick point and the augmentation, which are the same for all laws.
///
/// The laws of a list act together: their limits add, and so do the tractions of holding(). A law
/// without effect has the limit 0.
class FrictionLaw {
 public:
  virtual ~FrictionLaw() = default;

  /// Describes the keys of the law's constants, which are members of Friction.
  virtual void describe(keys::FieldVisitor& v, Friction& friction) const = 0;
  /// Whether the law has an effect with these constants.
  virtual bool acts(const Friction& friction) const = 0;

  /// Limit of the friction force in the slip plane; with `slides` it is not larger.
  /// Where the normal turns within a step, the limit is extrapolated by its slope: it is exact for
  /// a limit that is affine in the normal force.
  virtual FrictionLimit limit(const Friction& /*friction*/, const FrictionLoad& /*load*/) const {
    return {};
  }
  /// Whether the limit decreases where a touch begins to slip.
  virtual bool weakens(const Friction& /*friction*/) const { return false; }
  /// Traction up to which a touch, once pressed, is held in all directions [Pa]; 0: never held.
  virtual double holding(const Friction& /*friction*/) const { return 0.0; }
};

}  // namespace palpate::contact
