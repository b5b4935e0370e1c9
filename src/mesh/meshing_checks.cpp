// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing_checks.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <variant>

#include "palpate/base/error.h"
#include "palpate/base/number.h"
#include "palpate/base/vector_text.h"

namespace palpate::mesh {
namespace {

bool isPositive(double length) { return length > 0.0 && std::isfinite(length); }

std::string keyOf(std::size_t place) { return "edge_length.near[" + std::to_string(place) + "]"; }

void checkZone(const RefinementZone& place, const std::string& file, const std::string& key) {
  if (!isPositive(place.finest)) {
    throw InputError(file, key + ".finest", formatNumber(place.finest),
                     "must be a positive number [m]");
  }
  if (!(place.growth > 0.0 && place.growth <= 1.0)) {
    throw InputError(file, key + ".growth", formatNumber(place.growth), "must be in (0, 1]");
  }
  if (!(place.radius >= 0.0) || !std::isfinite(place.radius)) {
    throw InputError(file, key + ".radius", formatNumber(place.radius),
                     "must be a number >= 0 [m]");
  }
  const auto* line = std::get_if<Polyline>(&place.where);
  if (line && line->points.empty()) throw InputError(file, key, "", "must have a point");
}

std::string extentText(const std::vector<SurfaceMesh>& bodies) {
  Vec3 low = bodies.front().points.rowwise().minCoeff(), high = low;
  for (const SurfaceMesh& body : bodies) {
    low = low.cwiseMin(body.points.rowwise().minCoeff());
    high = high.cwiseMax(body.points.rowwise().maxCoeff());
  }
  return "the body reaches from " + vectorText(low) + " to " + vectorText(high) +
         " m in its own frame";
}

SizeEstimate& operator+=(SizeEstimate& sum, const SizeEstimate& other) {
  sum.tets += other.tets;
  sum.complete &= other.complete;
  for (std::size_t i = 0; i < sum.of_zone.size(); ++i) {
    sum.of_zone[i] += other.of_zone[i];
    sum.felt[i] = sum.felt[i] || other.felt[i];
  }
  return sum;
}

void refuseTooMany(const SizeEstimate& estimate, const MeshingOptions& options) {
  if (estimate.tets <= kMaxTets) return;
  std::ostringstream text;
  text << "is too small: it would make " << (estimate.complete ? "about " : "more than ")
       << estimate.tets << " tetrahedra, more than " << kMaxTets;
  const auto most = std::max_element(estimate.of_zone.begin(), estimate.of_zone.end());
  if (most == estimate.of_zone.end() || *most < 0.5 * estimate.tets) {
    const double length = options.edge_length.coarsest;
    if (estimate.complete && options.edge_length.uniform()) {
      text << "; must be at least " << length * std::cbrt(estimate.tets / kMaxTets)
           << " m for this body";
    }
    refuseEdgeLength(options, text.str());
  }
  const std::size_t place = static_cast<std::size_t>(most - estimate.of_zone.begin());
  const RefinementZone& fine = options.edge_length.near[place];
  text << "; raise it, lower radius (" << fine.radius << " m), or raise growth (" << fine.growth
       << ")";
  throw InputError(options.file, keyOf(place) + ".finest", formatNumber(fine.finest), text.str());
}

}  // namespace

void refuseEdgeLength(const MeshingOptions& options, const std::string& reason) {
  const SizeField& field = options.edge_length;
  std::ostringstream value;
  value << field.coarsest;
  throw InputError(options.file, field.uniform() ? "edge_length" : "edge_length.coarsest",
                   value.str(), reason);
}

void checkMeshing(const SurfaceMesh& surface, const MeshingOptions& options) {
  const double length = options.edge_length.coarsest;
  if (!isPositive(length)) refuseEdgeLength(options, "must be a positive number [m]");
  for (std::size_t i = 0; i < options.edge_length.near.size(); ++i) {
    checkZone(options.edge_length.near[i], options.file, keyOf(i));
  }
  if (!(enclosedVolume(surface) > 0.0)) {
    throw InputError(options.file, "", "", "the surface must be closed and face outward");
  }
  const double size =
      (surface.points.rowwise().maxCoeff() - surface.points.rowwise().minCoeff()).maxCoeff();
  if (length <= 0.5 * size) return;
  std::ostringstream text;
  text << "is too large: must be at most half of the body's largest side, " << 0.5 * size << " m";
  refuseEdgeLength(options, text.str());
}

std::vector<double> expectTets(const std::vector<SurfaceMesh>& bodies,
                               const MeshingOptions& options) {
  const SizeField& field = options.edge_length;
  SizeEstimate all;
  all.of_zone.assign(field.near.size(), 0.0);
  all.felt.assign(field.near.size(), false);
  std::vector<double> expected;
  for (const SurfaceMesh& body : bodies) {
    SizeEstimate estimate;
    if (field.uniform()) {
      estimate.tets = estimateTets(enclosedVolume(body), field.coarsest);
    } else {
      estimate = estimateTets(body, field, kMaxTets);
    }
    expected.push_back(estimate.tets);
    all += estimate;
  }
  refuseTooMany(all, options);
  for (std::size_t i = 0; all.complete && i < field.near.size(); ++i) {
    if (!all.felt[i]) {
      throw InputError(options.file, keyOf(i), "",
                       "makes nothing in the body finer than the coarsest; " + extentText(bodies));
    }
  }
  return expected;
}

}  // namespace palpate::mesh
