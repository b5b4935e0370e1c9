// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sstream>
#include <string>

#include "slab_scene.h"
#include "support/concave_surfaces.h"

namespace palpate::test {

/// The text of an .obj file.
inline std::string objText(const mesh::SurfaceMesh& surface) {
  std::ostringstream text;
  text.precision(17);
  for (Eigen::Index i = 0; i < surface.points.cols(); ++i) {
    text << "v " << surface.points.col(i).transpose() << "\n";
  }
  for (Eigen::Index t = 0; t < surface.triangles.cols(); ++t) {
    text << "f " << (surface.triangles.col(t).array() + 1).transpose() << "\n";
  }
  return text.str();
}

/// The slab and the probe, and files of bones: `plate.obj`, 200 x 200 x 20 mm with its top at z = 0
/// and its middle at x = y = 0; `hook.obj`, see hookSurface(), five times as large.
class AnatomyScene : public SlabScene {
 public:
  AnatomyScene() {
    mesh::SurfaceMesh plate =
        carved(Vec3(0.2, 0.2, 0.02), Eigen::Vector3i(2, 2, 1), [](const Vec3&) { return true; });
    plate.points.colwise() -= Vec3(0.1, 0.1, 0.02);
    folder().write("plate.obj", objText(plate));
    mesh::SurfaceMesh hook = hookSurface();
    hook.points *= 5.0;
    folder().write("hook.obj", objText(hook));
  }

  /// A line of the list.
  static std::string bone(const std::string& file, const std::string& position,
                          const std::string& more = "") {
    return "anatomy:\n  - {name: bone, surface: " + file + ", pose: {position: " + position + "}" +
           more + "}\n";
  }
};

}  // namespace palpate::test
