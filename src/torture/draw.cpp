// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/torture/draw.h"

#include <cmath>

namespace palpate::torture {
namespace {

std::uint64_t scrambled(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15ULL;

}  // namespace

Draw::Draw(std::uint64_t seed, std::uint64_t number)
    : state_(scrambled(scrambled(seed + kStep) ^ (number + kStep))) {}

std::uint64_t Draw::next() { return scrambled(state_ += kStep); }

double Draw::between(double low, double high) {
  return low + (high - low) * (static_cast<double>(next() >> 11) * 0x1p-53);
}

double Draw::decades(double low, double high) {
  return std::pow(10.0, between(std::log10(low), std::log10(high)));
}

int Draw::whole(int count) { return static_cast<int>(next() % static_cast<std::uint64_t>(count)); }

bool Draw::chance(double p) { return between(0.0, 1.0) < p; }

Vec3 Draw::direction() {
  const double z = between(-1.0, 1.0), angle = between(0.0, 2.0 * M_PI);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

Vec3 Draw::within(const Vec3& low, const Vec3& high) {
  const double x = between(low.x(), high.x()), y = between(low.y(), high.y());
  return {x, y, between(low.z(), high.z())};
}

}  // namespace palpate::torture
