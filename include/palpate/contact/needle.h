// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace palpate::contact {

/// Needle insertion [Okamura, Simone, O'Leary 2004, Force modeling for needle insertion into soft
/// tissue]: indentation until puncture, then a cutting force at the tip and friction on the shaft.
struct NeedleSettings {
  double puncture_force = 0.0;  ///< Axial force of puncture [N]; 0: no needle.
  double cutting_force = 0.0;   ///< Cutting force at the tip inside the tissue [N].
  double shaft_friction = 0.0;  ///< Shaft friction per inserted length [N/m].
};

}  // namespace palpate::contact
