// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/lanes.h"
#include "spring_span.h"

namespace palpate::tissue::PALPATE_ISA {
namespace {

constexpr double kNowhere = 2.2250738585072014e-308;  // shorter springs have no direction [m]

void draw(const SpringSpan& springs, const double* x, double* force, double* energy) {
  for (int s = 0; s < springs.count; s += kWidth) {
    Lanes way[3];
    for (int c = 0; c < 3; ++c)
      way[c] = gather(x + c, springs.b + s) - gather(x + c, springs.a + s);
    const Lanes distance = squareRoot(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
    const Lanes k = load(springs.stiffness + s), P = load(springs.preload + s),
                longer = distance - load(springs.length + s);
    const Lanes along = select(distance > kNowhere, distance, all(kNowhere));
    const Lanes pull = (P + k * longer) / along;
    for (int c = 0; c < 3; ++c)
      store(force + static_cast<long>(c) * springs.count + s, pull * way[c]);
    store(energy + s, (P + 0.5 * k * longer) * longer);
  }
}

}  // namespace

extern const SpringKernel kSpringKernel = draw;

}  // namespace palpate::tissue::PALPATE_ISA
