// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/torture/scene_files.h"

#include <sstream>

#include "draw_body.h"
#include "learned_files.h"
#include "palpate/base/atomic_file.h"
#include "palpate/base/number.h"
#include "palpate/formats/surface_io.h"
#include "palpate/formats/vtu_writer.h"
#include "palpate/io/trajectory.h"
#include "palpate/material/material.h"
#include "tool_files.h"

namespace palpate::torture {
namespace {

// Accuracy of positions over the size, a tenth of the rest criterion's.
constexpr double kAccuracy = 1e-5;

std::string listOf(const Vec3& v) {
  return "[" + formatNumber(v.x()) + ", " + formatNumber(v.y()) + ", " + formatNumber(v.z()) + "]";
}

std::string boxText(const Vec3& low, const Vec3& high) {
  return "{box: {min: " + listOf(low) + ", max: " + listOf(high) + "}}";
}

std::string materialText(const TortureOrgan& organ, double stiffer) {
  std::string text = "{law: " + organ.law;
  for (const auto& [name, values] : stiffened(organ.constants, stiffer)) {
    std::string list;
    for (const double value : values) list += (list.empty() ? "" : ", ") + formatNumber(value);
    text += ", " + name + ": " + (values.size() == 1 ? list : "[" + list + "]");
  }
  text += ", density: " + formatNumber(organ.density);
  if (organ.prony_g > 0.0) {
    text += ", viscoelastic: [{g: " + formatNumber(organ.prony_g) +
            ", tau: " + formatNumber(organ.prony_tau) + "}]";
  }
  return text + "}";
}

std::string modelText(const TortureOrgan& organ) {
  std::ostringstream out;
  const bool elements = organ.model == "fem" || organ.model == "enriched";
  if (elements) out << "    element: " << organ.element << "\n";
  if (organ.model != "fem") out << "    model: " << organ.model << "\n" << learnedText(organ);
  if (organ.adapt > 0.0) out << "    adapt: {finest: " << formatNumber(organ.adapt) << "}\n";
  if (organ.scheme != "implicit") out << "    springs: {scheme: " << organ.scheme << "}\n";
  if (organ.model == "hybrid") {
    const Vec3 top = organ.low + organ.size.cwiseProduct(Vec3(0.5, 0.5, 1.0));
    out << "    hybrid: {region: {sphere: {center: " << listOf(top)
        << ", radius: " << formatNumber(0.7 * organ.size.z()) << "}}}\n";
  }
  if (organ.model == "sampled_elasticity") {
    out << "    sampling: {coarsest: " << formatNumber(organ.size.z() / 3.0)
        << ", coarsen_below: " << formatNumber(kAccuracy * organ.size.norm()) << "}\n";
  }
  if (organ.model == "honeycomb") {
    out << "    honeycomb: {cell_size: " << formatNumber(organ.size.z() / 3.0) << "}\n";
  }
  if (organ.model == "cloth") {
    const double spacing = organ.size.x() / 10.0;
    out << "    cloth: {thickness: " << formatNumber(kSheetThickness)
        << ", width: " << formatNumber(organ.size.x())
        << ", length: " << formatNumber(organ.size.y()) << ", spacing: " << formatNumber(spacing)
        << "}\n    pose: {position: " << listOf(organ.low + organ.size.z() * Vec3::UnitZ())
        << "}\n";
  }
  return out.str();
}

// Supports of a sheet in its own frame: two rows at each of two ends.
std::string supportText(const TortureOrgan& organ) {
  const Vec3 all = Vec3::Constant(10.0);
  if (organ.model == "cloth") {
    const double row = 0.1 * organ.size.y();
    const Vec3 first(10.0, row, 10.0), last(-10.0, organ.size.y() - row, -10.0);
    return "[{select: " + boxText(-all, first) + "}, {select: " + boxText(last, all) + "}]";
  }
  return "[{select: " + boxText(-all, Vec3(10.0, 10.0, organ.heldTo())) + "}]";
}

std::string organText(const TortureOrgan& organ, const std::string& folder) {
  std::ostringstream out;
  out << "  - name: " << organ.name << "\n";
  if (organ.surface.points.cols() > 0) {
    formats::writeSurface(folder + "/" + organ.name + ".obj", organ.surface);
    out << "    surface: " << organ.name
        << ".obj\n    edge_length: " << formatNumber(organ.edge_length) << "\n";
  } else if (organ.model != "cloth") {
    formats::writeVtu(folder + "/" + organ.name + ".vtu", organ.mesh, {}, {});
    out << "    tetrahedra: " << organ.name << ".vtu\n";
  }
  if (organ.model == "bem") {
    out << "    edge_length: " << formatNumber(organ.size.z() / 3.0) << "\n";
  }
  out << modelText(organ) << "    material: " << materialText(organ, 1.0) << "\n";
  if (material::needsFibres(material::makeMaterial(organ.law, organ.constants))) {
    out << "    fibres: {direction: [1, 0.3, 0.1]}\n";
  }
  if (organ.contrast > 1.0) {
    const Vec3 middle = organ.low + 0.5 * organ.size;
    out << "    regions:\n      - {name: stiff, select: {half_space: {point: " << listOf(middle)
        << ", normal: [0, 0, 1]}}, material: " << materialText(organ, organ.contrast) << "}\n";
  }
  out << "    damping: {mass: " << formatNumber(organ.mass_damping)
      << ", stiffness: " << formatNumber(organ.stiffness_damping) << "}\n";
  if (organ.held) out << "    supports: " << supportText(organ) << "\n";
  return out.str();
}

std::string boneText(const TortureScene& scene, const std::string& folder) {
  if (!scene.bone) return "";
  const TortureOrgan& organ = scene.organs.front();
  mesh::TetMesh block = mesh::boxMesh(Vec3(2.0 * organ.size.x(), 2.0 * organ.size.y(), 0.02),
                                      Eigen::Vector3i(2, 2, 2));
  const Vec3 low = organ.low - 0.5 * Vec3(organ.size.x(), organ.size.y(), 0.0);
  block.points.colwise() += Vec3(low.x(), low.y(), -0.02);
  const Eigen::Matrix3Xi faces = mesh::boundaryTriangles(block.tets);
  formats::writeSurface(folder + "/bone.obj", mesh::SurfaceMesh{block.points, faces});
  return "anatomy:\n  - {name: bone, surface: bone.obj}\n";
}

}  // namespace

std::string SceneFiles::command() const {
  const std::string folder = scene.substr(0, scene.rfind('/'));
  return "palpate replay " + scene + " --trajectory " + trajectory +
         (state.empty() ? "" : " --initial-state " + state) + " --out " + folder + "/result.csv";
}

SceneFiles writeScene(const TortureScene& scene, const std::string& folder) {
  SceneFiles files{folder + "/scene.yaml", folder + "/trajectory.csv", ""};
  if (scene.start != Start::kRest) files.state = folder + "/start.state";
  std::ostringstream out;
  out << "# " << describe(scene) << "\nname: torture " << scene.seed << " " << scene.number
      << "\ngravity: " << listOf(scene.gravity) << "\norgans:\n";
  for (const TortureOrgan& organ : scene.organs) out << organText(organ, folder);
  out << "instruments:\n";
  for (const TortureTool& tool : scene.tools) out << writeTool(tool, folder);
  out << boneText(scene, folder);
  out << "contact:\n  model: " << scene.contact << "\n";
  if (scene.contact == "prescribed") out << "  organs: false\n";
  if (scene.friction > 0.0) {
    out << "  friction: {static: " << formatNumber(scene.friction)
        << ", kinetic: " << formatNumber(0.8 * scene.friction) << "}\n";
  }
  out << "solver:\n  method: " << scene.method << "\n";
  if (scene.integrator != "backward_euler") out << "  integrator: " << scene.integrator << "\n";
  out << "  step: " << formatNumber(scene.step)
      << "\n  position_tolerance: " << formatNumber(kAccuracy * scene.size()) << "\n";
  writeFileAtomically(files.scene, out.str());
  io::writeTrajectory(files.trajectory, scene.trajectory);
  return files;
}

}  // namespace palpate::torture
