// SPDX-License-Identifier: GPL-3.0-or-later
#include "limits.h"

#include <cmath>
#include <stdexcept>

namespace palpate::haptics {
namespace {

[[noreturn]] void refuse(const std::string& owner, const std::string& name, double value,
                         const std::string& allowed) {
  throw std::invalid_argument(owner + ": " + name + " = " + std::to_string(value) +
                              "; must be finite and " + allowed);
}

// Direction of a vector with infinite components.
Vec3 infiniteOnes(const Vec3& v) {
  return v.unaryExpr([](double x) { return std::isinf(x) ? std::copysign(1.0, x) : 0.0; });
}

}  // namespace

Vec3 clamped(const Vec3& v, double limit) {
  const double norm = v.stableNorm();
  if (!(norm > limit)) return v;
  if (!v.allFinite()) return clamped(infiniteOnes(v), limit);
  if (!std::isfinite(norm)) return clamped(0.125 * v, limit);
  return v * (limit / norm);
}

Vec3 approached(const Vec3& from, const Vec3& to, double limit) {
  return from + clamped(to - from, limit);
}

void requirePositive(const std::string& owner, const std::string& name, double value) {
  if (!std::isfinite(value) || !(value > 0.0)) refuse(owner, name, value, "> 0");
}

void requireNotNegative(const std::string& owner, const std::string& name, double value) {
  if (!std::isfinite(value) || value < 0.0) refuse(owner, name, value, ">= 0");
}

}  // namespace palpate::haptics
