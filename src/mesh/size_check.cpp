// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/size_check.h"

#include <cmath>
#include <sstream>

#include "palpate/base/error.h"

namespace palpate::mesh {
namespace {

struct Unit {
  const char* name;
  double scale;
};

// In the order of frequency in medical meshes.
constexpr Unit kUnits[] = {
    {"millimetres", 1e-3}, {"centimetres", 1e-2}, {"micrometres", 1e-6}, {"kilometres", 1e3}};
constexpr double kUsualMin = 0.02, kUsualMax = 0.5, kUsual = 0.15;  // [m]

std::string suggestion(double size) {
  std::ostringstream text;
  for (const Unit& unit : kUnits) {
    if (size * unit.scale < kUsualMin || size * unit.scale > kUsualMax) continue;
    text << "looks like " << unit.name << ": try `scale: " << unit.scale << "`";
    return text.str();
  }
  text << "if the file is in another unit, give its `scale`, perhaps "
       << std::pow(10.0, std::round(std::log10(kUsual / size)));
  return text.str();
}

}  // namespace

void checkSize(const Points& points, const std::string& file, const std::string& key) {
  if (points.cols() == 0) throw InputError(file, key, "", "there are no points");
  if (!points.allFinite()) throw InputError(file, key, "", "coordinates must be finite numbers");
  const double size = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).maxCoeff();
  if (size >= kMinOrganSize && size <= kMaxOrganSize) return;
  std::ostringstream text;
  text << "the largest side of the bounding box is " << size << " m, must be in [" << kMinOrganSize
       << ", " << kMaxOrganSize << "] m";
  if (size > 0.0 && std::isfinite(size)) text << "; " << suggestion(size);
  throw InputError(file, key, "", text.str());
}

}  // namespace palpate::mesh
