// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace palpate::contact {

/// How a needle goes into tissue [Okamura, Simone, O'Leary 2004, Force modeling for needle
/// insertion into soft tissue]: it indents the surface until it punctures it; then its tip cuts
/// with a force of its own and the shaft rubs along what it has gone through.
struct NeedleSettings {
  double puncture_force = 0.0;  ///< Along the axis [N]; 0: it is no needle.
  double cutting_force = 0.0;   ///< Of the tip, inside [N].
  double shaft_friction = 0.0;  ///< Along the shaft, per length inside [N/m].
};

}  // namespace palpate::contact
