// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "palpate/material/material.h"

namespace palpate::test {

/// Whether the law's stress or tangent may jump close to F, where no finite difference can be
/// trusted: fibres about to slacken, a rotation about to flip. False for a law that says nothing.
template <class Law>
bool nearKink(const Law&, const Mat3&) {
  return false;
}

inline bool nearKink(const material::Corotational&, const Mat3& F) {
  const Vec3 s = material::principalStretches(F).s;
  return s(1) + s(2) < 0.1;
}

}  // namespace palpate::test
