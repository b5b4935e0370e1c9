// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "palpate/base/error.h"
#include "surface_builder.h"
#include "surface_formats.h"
#include "vrml.h"

namespace palpate::formats {
namespace {

// Nested USE can multiply without bound. Limits: visited nodes, and numbers beyond those of the
// file.
constexpr int kMostVisits = 1000000;
constexpr std::size_t kMostRepeated = 2000000;

template <std::size_t n>
bool isOneOf(const std::string& type, const char* const (&list)[n]) {
  return std::find(list, list + n, type) != list + n;
}

constexpr const char* kGroups[] = {"Group", "Transform", "Anchor", "Billboard", "Collision"};
constexpr const char* kOtherSolids[] = {"Box",    "Cone",          "Cylinder",
                                        "Sphere", "ElevationGrid", "Extrusion"};

class Walker {
 public:
  Walker(const std::string& file, std::size_t bytes)
      : file_(file), builder_(file), numbers_left_(bytes / 2 + kMostRepeated) {}

  void visit(const VrmlNode& node, const Eigen::Affine3d& X_WP) {
    if (++visits_ > kMostVisits) fail(node, "there are too many nodes");
    if (isOneOf(node.type, kGroups)) {
      const Eigen::Affine3d X_WC = node.type == "Transform" ? X_WP * transform(node) : X_WP;
      for (const auto& child : node.field("children").nodes) visit(*child, X_WC);
    } else if (node.type == "Switch") {
      const auto& choices = node.field("choice").nodes;
      const double which = values(node, "whichChoice", {-1.0})[0];
      if (which >= 0.0 && which < static_cast<double>(choices.size())) {
        visit(*choices[static_cast<std::size_t>(which)], X_WP);
      }
    } else if (node.type == "LOD") {  // the finest level is first
      const auto& levels = node.field("level").nodes;
      if (!levels.empty()) visit(*levels[0], X_WP);
    } else if (node.type == "Shape") {
      for (const auto& geometry : node.field("geometry").nodes) addGeometry(*geometry, X_WP);
    } else if (node.type == "Inline") {
      fail(node, "Inline files are not read; write one file");
    }
  }

  mesh::SurfaceMesh finish() { return builder_.finish(); }

 private:
  [[noreturn]] void fail(const VrmlNode& node, const std::string& allowed) const {
    throw InputError(file_, node.where, node.type, allowed);
  }

  /// Field `name`, which must have as many numbers as `fallback`; if absent, `fallback`.
  std::vector<double> values(const VrmlNode& node, const char* name,
                             const std::vector<double>& fallback) const {
    if (!node.has(name)) return fallback;
    const std::vector<double>& v = node.field(name).numbers;
    if (v.size() != fallback.size()) {
      fail(node, std::string(name) + " must have " + std::to_string(fallback.size()) + " numbers");
    }
    return v;
  }
  Vec3 vector(const VrmlNode& node, const char* name, double fallback) const {
    return Vec3(values(node, name, {fallback, fallback, fallback}).data());
  }
  Eigen::Quaterniond rotation(const VrmlNode& node, const char* name) const {
    const std::vector<double> v = values(node, name, {0.0, 0.0, 1.0, 0.0});
    const Vec3 axis(v.data());
    if (v[3] == 0.0) return Eigen::Quaterniond::Identity();
    if (axis.isZero(0.0)) fail(node, std::string(name) + " must have an axis");
    const double length = axis.norm();
    const bool has_square = length > 0.0 && std::isfinite(length);
    return Eigen::Quaterniond(
        Eigen::AngleAxisd(v[3], has_square ? axis.normalized() : axis.stableNormalized()));
  }

  /// p' = T C R SR S SR^-1 C^-1 p [VRML97, ISO/IEC 14772-1, 6.52].
  Eigen::Affine3d transform(const VrmlNode& node) const {
    const Vec3 center = vector(node, "center", 0.0);
    const Eigen::Quaterniond stretch = rotation(node, "scaleOrientation");
    Eigen::Affine3d X = Eigen::Affine3d::Identity();
    X.translate(vector(node, "translation", 0.0) + center);
    X.rotate(rotation(node, "rotation"));
    X.rotate(stretch);
    X.scale(vector(node, "scale", 1.0));
    X.rotate(stretch.conjugate());
    X.translate(-center);
    return X;
  }

  void count(const VrmlNode& node, std::size_t numbers) {
    if (numbers > numbers_left_) {
      fail(node, "USE must not repeat more than " + std::to_string(kMostRepeated) + " numbers");
    }
    numbers_left_ -= numbers;
  }

  void addGeometry(const VrmlNode& node, const Eigen::Affine3d& X_WP) {
    if (isOneOf(node.type, kOtherSolids)) fail(node, "must be an IndexedFaceSet");
    if (node.type != "IndexedFaceSet") return;  // lines, points, text
    const auto& coords = node.field("coord").nodes;
    const std::vector<double> none;
    const std::vector<double>& xyz = coords.empty() ? none : coords.back()->field("point").numbers;
    count(node, xyz.size() + node.field("coordIndex").numbers.size());
    if (xyz.size() % 3 != 0) fail(node, "the numbers in 'point' must be a multiple of 3");
    const auto first = static_cast<std::int64_t>(builder_.numPoints());
    for (std::size_t i = 0; i < xyz.size(); i += 3) {
      builder_.addPoint(X_WP * Vec3(xyz[i], xyz[i + 1], xyz[i + 2]));
    }
    // A mirroring transform reverses the corner order, as does ccw FALSE.
    const bool ccw = values(node, "ccw", {1.0})[0] != 0.0;
    addFaces(node, first, ccw == (X_WP.linear().determinant() >= 0.0));
  }

  void addFaces(const VrmlNode& node, std::int64_t first, bool keep_order) {
    const auto end = static_cast<std::int64_t>(builder_.numPoints());
    std::vector<std::int64_t> corners;
    std::size_t face = 0;
    const auto close = [&] {
      ++face;
      if (!keep_order) std::reverse(corners.begin(), corners.end());
      builder_.addPolygon(corners, first, end, [&] {
        return node.where + ", IndexedFaceSet: face " + std::to_string(face);
      });
      corners.clear();
    };
    for (const double index : node.field("coordIndex").numbers) {
      if (index != std::floor(index)) fail(node, "coordIndex must have whole numbers");
      if (index == -1.0) {
        close();
      } else {
        const bool fits = index >= 0.0 && index < static_cast<double>(end);
        corners.push_back(fits ? first + static_cast<std::int64_t>(index) : -1);
      }
    }
    if (!corners.empty()) close();  // the last -1 is optional
  }

  const std::string file_;
  SurfaceBuilder builder_;
  std::size_t numbers_left_;
  int visits_ = 0;
};

}  // namespace

mesh::SurfaceMesh readWrl(const std::string& file, std::string_view bytes) {
  Walker walker(file, bytes.size());
  for (const auto& node : parseVrml(file, bytes)) walker.visit(*node, Eigen::Affine3d::Identity());
  return walker.finish();
}

}  // namespace palpate::formats
