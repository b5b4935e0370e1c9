// SPDX-License-Identifier: GPL-3.0-or-later
#include "surroundings.h"

#include <filesystem>
#include <stdexcept>

#include "palpate/base/error.h"
#include "palpate/base/resource.h"
#include "palpate/base/vector_text.h"
#include "palpate/fem/loads.h"
#include "palpate/formats/trajectory.h"
#include "palpate/mesh/cavities.h"
#include "palpate/scene/tissue_file.h"
#include "support_kinds.h"

namespace palpate::scene {
namespace {

std::string supportKey(const std::string& organ, std::size_t support) {
  return organ + ".supports[" + std::to_string(support) + "]";
}

std::vector<int> selected(const Points& X, const mesh::Region& region, const Scene& scene,
                          const std::string& key) {
  std::vector<int> nodes = mesh::selectPoints(X, region);
  if (!nodes.empty()) return nodes;
  const Vec3 low = X.rowwise().minCoeff(), high = X.rowwise().maxCoeff();
  throw InputError(scene.file, key + ".select", "",
                   "must select at least one node; the organ reaches from " + vectorText(low) +
                       " to " + vectorText(high) + " m in its own frame");
}

Eigen::MatrixXi selectedFaces(const Eigen::MatrixXi& surface, const std::vector<int>& nodes,
                              const Scene& scene, const std::string& key) {
  Eigen::MatrixXi faces = fem::selectFaces(surface, nodes);
  if (faces.cols() > 0) return faces;
  throw InputError(scene.file, key + ".select", "",
                   "must select a face of the organ's surface, with all its corners; it selects " +
                       std::to_string(nodes.size()) + " nodes and no such face");
}

tissue::Motion readMotion(const MotionConfig& config, const Mat3& R_WO, const Scene& scene,
                          const std::string& key) {
  std::string file;
  try {
    const std::string folder = std::filesystem::path(scene.file).parent_path().string();
    file = resolveResource(config.file, folder);
  } catch (const std::invalid_argument& error) {
    throw InputError(scene.file, key + ".file", config.file, error.what());
  }
  const formats::Trajectory table = formats::readTrajectory(file);
  if (table.columns != std::vector<std::string>{"x", "y", "z"}) {
    throw InputError(file, "", joinNames(table.columns), "the first row must be t,x,y,z");
  }
  try {
    return tissue::Motion(tissue::MotionTable{table.t, R_WO * table.values, config.periodic});
  } catch (const std::invalid_argument& error) {
    throw InputError(file, "", "", error.what());
  }
}

std::optional<tissue::Motion> motionOf(const SupportConfig& support, const Mat3& R_WO,
                                       const Scene& scene, const std::string& key) {
  if (!support.motion) return std::nullopt;
  if (!support.motion->file.empty()) return readMotion(*support.motion, R_WO, scene, key);
  tissue::Wave wave = *support.motion;
  wave.amplitude = R_WO * wave.amplitude;
  return tissue::Motion(wave);
}

std::vector<int> pressedNodes(const PressureConfig& pressure, const mesh::TetMesh& mesh,
                              const Scene& scene, const std::string& key) {
  if (pressure.select) {
    std::vector<int> nodes = selected(mesh.points, *pressure.select, scene, key);
    selectedFaces(mesh::boundaryFaces(mesh), nodes, scene, key);
    return nodes;
  }
  const std::vector<std::vector<int>> cavities = mesh::cavityNodes(mesh);
  const auto cavity = static_cast<std::size_t>(pressure.cavity.value_or(0));
  if (cavity < cavities.size()) return cavities[cavity];
  throw InputError(
      scene.file, key + ".cavity", std::to_string(cavity),
      cavities.empty()
          ? "the organ's mesh has no cavity: its surface needs a second closed shell "
            "inside the outer one"
          : "the organ's mesh has " + std::to_string(cavities.size()) + ", counted from 0");
}

void addPressures(const Scene& scene, const OrganConfig& organ, const mesh::TetMesh& mesh,
                  const std::string& organ_key, tissue::Surroundings* all) {
  for (std::size_t p = 0; p < organ.pressure.size(); ++p) {
    const PressureConfig& config = organ.pressure[p];
    const std::string key = organ_key + ".pressure[" + std::to_string(p) + "]";
    const std::vector<int> nodes = pressedNodes(config, mesh, scene, key);
    const Eigen::MatrixXi faces = fem::selectFaces(mesh::boundaryFaces(mesh), nodes);
    try {
      const fem::CavityPressure check(mesh.points, faces, config);
    } catch (const std::invalid_argument&) {
      throw InputError(scene.file, key + ".volume_stiffness", "",
                       "needs faces that enclose a cavity: choose it by `cavity`");
    }
    all->pressures.push_back({nodes, config});
  }
}

double youngModulus(const OrganConfig& organ, const Scene& scene, const std::string& key) {
  const material::Moduli m =
      material::moduli(makeSolid(organ.material, scene.file, key + ".material").law);
  return 9.0 * m.kappa * m.mu / (3.0 * m.kappa + m.mu);
}

}  // namespace

tissue::Surroundings surroundingsOf(const Scene& scene, const OrganConfig& organ,
                                    const mesh::TetMesh& mesh, const std::string& key) {
  tissue::Surroundings all(fem::FreeMask::Ones(3, mesh.numPoints()));
  addPressures(scene, organ, mesh, key, &all);
  if (organ.supports.empty()) return all;
  const Pose X_WO = organ.pose.pose();
  const Points points = X_WO * mesh.points.colwise().homogeneous();
  const Eigen::MatrixXi surface = mesh::boundaryFaces(mesh);
  for (std::size_t s = 0; s < organ.supports.size(); ++s) {
    const SupportConfig& config = organ.supports[s];
    const SupportKind& kind = supportKind(config.kind);
    const std::string own_key = supportKey(key, s);
    SelectedSupport place{config, selected(mesh.points, config.select, scene, own_key),
                          points, {},
                          0.0,    motionOf(config, X_WO.linear(), scene, own_key + ".motion")};
    if (kind.on_faces) {
      place.faces = selectedFaces(surface, place.nodes, scene, own_key);
      place.young_modulus = youngModulus(organ, scene, key);
    }
    kind.add(place, &all);
  }
  return all;
}

fem::FreeMask glued(const Scene& scene, const OrganConfig& organ, const Points& X,
                    const std::string& key) {
  fem::FreeMask free = fem::FreeMask::Ones(3, X.cols());
  if (!organ.pressure.empty()) {
    throw InputError(scene.file, key + ".pressure", "", "model " + organ.model + " knows none");
  }
  for (std::size_t s = 0; s < organ.supports.size(); ++s) {
    const SupportConfig& support = organ.supports[s];
    const std::string own_key = supportKey(key, s);
    const std::string only =
        "model " + organ.model + " knows organs that are glued and at rest only";
    if (support.kind != supportKindNames().front()) {
      throw InputError(scene.file, own_key + ".kind", support.kind, only);
    }
    if (support.motion) throw InputError(scene.file, own_key + ".motion", "", only);
    for (const int i : selected(X, support.select, scene, own_key)) free.col(i).setZero();
  }
  return free;
}

}  // namespace palpate::scene
