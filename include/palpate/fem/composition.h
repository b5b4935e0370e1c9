// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/material/solid.h"

namespace palpate::fem {

/// Material of each tetrahedron of a body.
struct Composition {
  /// A single solid for all tetrahedra.
  static Composition uniform(material::Material law, double density = 1000.0) {
    return {{{std::move(law), density, {}}}, {}, {}};
  }

  std::vector<material::Solid> solids;  ///< At least one.
  std::vector<int> solid_of;  ///< Index of each tetrahedron's solid in `solids`; empty: all 0.
  /// Rotation of each tetrahedron from material to reference frame: columns fibre, sheet, their
  /// normal. The identity where the law is not frame indifferent; empty if no solid needs fibres.
  std::vector<Mat3> frames;

  /// Least shear modulus at rest over all solids [Pa].
  double softestShearModulus() const {
    double softest = std::numeric_limits<double>::infinity();
    for (const material::Solid& s : solids) softest = std::min(softest, material::moduli(s.law).mu);
    return softest;
  }
  const material::Solid& solid(int tet) const {
    return solids[solid_of.empty() ? 0 : static_cast<std::size_t>(solid_of[tet])];
  }
};

}  // namespace palpate::fem
