// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/skin/profile_fit.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace palpate::skin {

double surfaceDepth(const UnitIndentation& unit, double depth, double radius) {
  const bool rings = unit.block.idealization == Idealization::kAxisymmetric;
  const auto radiusOf = [&](int node) {
    const double x = unit.mesh.points(0, node) + depth * unit.displacement(0, node);
    return rings ? x : 0.5 * unit.block.width - x;
  };
  const auto depthOf = [&](int node) { return depth * unit.displacement(1, node); };
  double r = radiusOf(unit.surface.front());
  if (radius >= r) return depthOf(unit.surface.front());
  for (std::size_t k = 1; k < unit.surface.size(); ++k) {
    const double next = radiusOf(unit.surface[k]);
    if (radius >= next) {
      const double outer = depthOf(unit.surface[k - 1]), inner = depthOf(unit.surface[k]);
      return outer + (inner - outer) * (r - radius) / (r - next);
    }
    r = next;
  }
  return depthOf(unit.surface.back());
}

ProfileErrors profileErrors(const UnitIndentation& unit, double depth,
                            const MeasuredProfile& profile) {
  ProfileErrors errors;
  double sum = 0.0;
  for (int k = 0; k < profile.size(); ++k) {
    const double e = surfaceDepth(unit, depth, profile.radius(k)) - profile.depth(k);
    sum += e * e;
    errors.largest = std::max(errors.largest, std::abs(e));
  }
  errors.published = std::sqrt(sum) / profile.size();
  errors.mean_square = sum / profile.size();
  errors.rms = std::sqrt(errors.mean_square);
  return errors;
}

double correctedDepth(const UnitIndentation& unit, double depth, const MeasuredProfile& profile) {
  return depth - (surfaceDepth(unit, depth, profile.radius(0)) - profile.depth(0));
}

double pinnedDepth(const UnitIndentation& unit, const MeasuredProfile& profile, double within) {
  double depth = profile.start_depth;
  for (int k = 0; k < 1000; ++k) {
    const double next = correctedDepth(unit, depth, profile);
    if (!std::isfinite(next)) break;
    if (std::abs(next - depth) <= within) return next;
    depth = next;
  }
  throw std::domain_error("no depth brings the surface to what was read nearest to the load");
}

}  // namespace palpate::skin
