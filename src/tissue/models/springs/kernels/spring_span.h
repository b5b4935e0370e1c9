// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plain data: kernels include it.

namespace palpate::tissue {

/// Springs as arrays of a multiple of eight; those that fill it up are from point 0 to itself.
/// `a`, `b`: three times the ends.
struct SpringSpan {
  const int *a, *b;
  const double *stiffness, *preload, *length;
  int count;
};

/// Of every spring its energy [J] and, `count` apart, the components of the force that draws its
/// first end to the second [N], for points x, y, z, x, ... [m].
using SpringKernel = void (*)(const SpringSpan& springs, const double* x, double* force,
                              double* energy);

}  // namespace palpate::tissue
