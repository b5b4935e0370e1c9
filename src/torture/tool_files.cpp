// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool_files.h"

#include <sstream>

#include "palpate/base/atomic_file.h"
#include "palpate/base/number.h"
#include "palpate/formats/surface_io.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::torture {
namespace {

// An octahedron.
mesh::SurfaceMesh hull(const Vec3& half) {
  mesh::SurfaceMesh surface;
  surface.points.resize(3, 6);
  for (int c = 0; c < 3; ++c) {
    surface.points.col(2 * c) = half[c] * Vec3::Unit(c);
    surface.points.col(2 * c + 1) = -half[c] * Vec3::Unit(c);
  }
  surface.triangles.resize(3, 8);
  for (int k = 0; k < 8; ++k) {
    const int x = k & 1, y = 2 + ((k >> 1) & 1), z = 4 + (k >> 2);
    const bool mirrored = (k & 1) ^ ((k >> 1) & 1) ^ (k >> 2);
    surface.triangles.col(k) = mirrored ? Eigen::Vector3i(y, x, z) : Eigen::Vector3i(x, y, z);
  }
  return surface;
}

// An L: eight cells of a box without the upper ones at +x.
mesh::SurfaceMesh hook(const Vec3& half) {
  const mesh::TetMesh box = mesh::boxMesh(2.0 * half, Eigen::Vector3i(2, 2, 2));
  std::vector<Eigen::Index> kept;
  for (Eigen::Index t = 0; t < box.numTets(); ++t) {
    Vec3 middle = Vec3::Zero();
    for (int k = 0; k < 4; ++k) middle += 0.25 * box.points.col(box.tets(k, t));
    if (middle.x() < half.x() || middle.z() < half.z()) kept.push_back(t);
  }
  Eigen::Matrix4Xi tets(4, static_cast<Eigen::Index>(kept.size()));
  for (std::size_t k = 0; k < kept.size(); ++k) {
    tets.col(static_cast<Eigen::Index>(k)) = box.tets.col(kept[k]);
  }
  return {box.points.colwise() - half, mesh::boundaryTriangles(tets)};
}

std::string geometryOf(const TortureTool& tool, const std::string& folder) {
  const Vec3& s = tool.size;
  if (tool.shape == "ball") return "<sphere radius=\"" + formatNumber(s.x()) + "\"/>";
  if (tool.shape == "box" || tool.shape == "blade") {
    return "<box size=\"" + formatNumber(2.0 * s.x()) + " " + formatNumber(2.0 * s.y()) + " " +
           formatNumber(2.0 * s.z()) + "\"/>";
  }
  if (tool.shape == "hull" || tool.shape == "hook") {
    const std::string file = tool.name + ".obj";
    formats::writeSurface(folder + "/" + file, tool.shape == "hull" ? hull(s) : hook(s));
    return "<mesh filename=\"" + file + "\"/>";
  }
  return "<cylinder radius=\"" + formatNumber(s.x()) + "\" length=\"" + formatNumber(2.0 * s.z()) +
         "\"/>";
}

}  // namespace

std::string writeTool(const TortureTool& tool, const std::string& folder) {
  static constexpr const char* kAxes[] = {"1 0 0", "0 1 0", "0 0 1"};
  static constexpr const char* kNames[] = {"x", "y", "z", "roll", "pitch", "yaw"};
  std::ostringstream out;
  out << "<?xml version=\"1.0\"?>\n<robot name=\"" << tool.name << "\">\n  <link name=\"base\"/>\n";
  for (int k = 0; k < 5; ++k) out << "  <link name=\"" << kNames[k] << "_link\"/>\n";
  out << "  <link name=\"tip\">\n    <collision><geometry>" << geometryOf(tool, folder)
      << "</geometry></collision>\n  </link>\n";
  for (int k = 0; k < 6; ++k) {
    out << "  <joint name=\"" << kNames[k] << "\" type=\"" << (k < 3 ? "prismatic" : "continuous")
        << "\">\n    <parent link=\"" << (k == 0 ? "base" : std::string(kNames[k - 1]) + "_link")
        << "\"/><child link=\"" << (k == 5 ? "tip" : std::string(kNames[k]) + "_link")
        << "\"/><axis xyz=\"" << kAxes[k % 3] << "\"/>";
    if (k < 3) out << "<limit lower=\"-10\" upper=\"10\" effort=\"1\" velocity=\"10\"/>";
    out << "\n  </joint>\n";
  }
  out << "</robot>\n";
  writeFileAtomically(folder + "/" + tool.name + ".urdf", out.str());
  return "  - {name: " + tool.name + ", urdf: " + tool.name + ".urdf, control_frame: tip" +
         (tool.shape == "cylinder" ? ", cylinder_as_capsule: false" : "") + "}\n";
}

}  // namespace palpate::torture
