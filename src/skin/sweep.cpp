// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/skin/sweep.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include "palpate/skin/limits.h"

namespace palpate::skin {

std::vector<double> geometricRatios() {
  std::vector<double> ratios;
  for (int power = 2; power <= 512; power *= 2) ratios.push_back(power - 1);
  return ratios;
}

std::vector<double> linearRatios() {
  std::vector<double> ratios;
  for (int ratio = 7; ratio <= 15; ++ratio) ratios.push_back(ratio);
  return ratios;
}

std::vector<SweepPoint> sweep(const TwoLayerBlock& block, const std::vector<double>& ratios,
                              DepthProtocol protocol) {
  std::vector<SweepPoint> points;
  std::array<double, kProfileSets> depths{};
  for (int set = 0; set < kProfileSets; ++set) {
    depths[static_cast<std::size_t>(set)] = measuredProfile(set + 1).start_depth;
  }
  TwoLayerBlock next = block;
  for (next.upper_rows = 1; next.upper_rows < block.rows; ++next.upper_rows) {
    for (const double ratio : ratios) {
      next.stiffness_ratio = ratio;
      const UnitIndentation unit = indent(next);
      SweepPoint point{next.upper_rows, ratio, {}, inversionDepth(unit), boneDepth(unit)};
      for (std::size_t set = 0; set < kProfileSets; ++set) {
        const MeasuredProfile& profile = measuredProfile(static_cast<int>(set) + 1);
        double& depth = depths[set];
        if (protocol == DepthProtocol::kConverged) {
          depth = pinnedDepth(unit, profile);
        } else {
          for (int k = 0; k < kPublishedCorrections; ++k) {
            depth = correctedDepth(unit, depth, profile);
          }
        }
        point.sets[set] = {depth, profileErrors(unit, depth, profile), depth * unit.force};
      }
      points.push_back(point);
    }
  }
  return points;
}

double Criterion::operator()(const SweepPoint& point) const {
  const double a = point.sets[0].errors.published, b = point.sets[1].errors.published;
  if (kind == Kind::kLargest) return std::max(a, b);
  return kind == Kind::kSum ? a + b : weight * a + (1.0 - weight) * b;
}

const SweepPoint& optimum(const std::vector<SweepPoint>& points, const Criterion& criterion) {
  if (points.empty()) throw std::invalid_argument("no points to choose from");
  return *std::min_element(
      points.begin(), points.end(),
      [&](const SweepPoint& a, const SweepPoint& b) { return criterion(a) < criterion(b); });
}

std::vector<SweepPoint> acceptable(const std::vector<SweepPoint>& points,
                                   const Criterion& criterion, double times) {
  const double limit = times * criterion(optimum(points, criterion));
  std::vector<SweepPoint> found;
  for (const SweepPoint& point : points) {
    if (criterion(point) <= limit) found.push_back(point);
  }
  return found;
}

}  // namespace palpate::skin
