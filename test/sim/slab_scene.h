// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <string>
#include <vector>

#include "palpate/formats/vtu_writer.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/sim/simulator.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"

namespace palpate::test {

/// A slab 100 x 100 x 40 mm under the shipped probe, whose ball of 5 mm is at [x, y, z + 0.1] for
/// joints x, y, z.
class SlabScene {
 public:
  SlabScene() {
    formats::writeVtu(folder_.path("slab.vtu"),
                      mesh::boxMesh(Vec3(0.1, 0.1, 0.04), Eigen::Vector3i(6, 6, 3)), {}, {});
  }

  /// The scene file's path; `extra` are further top-level lines, `organ` further ones of the organ.
  std::string file(const std::string& extra = "", const std::string& organ = "") const {
    return folder_.write("slab.yaml", R"(
name: slab
organs:
  - name: slab
    tetrahedra: slab.vtu
    pose: {position: [-0.05, -0.05, 0]}
    material: {law: stable_neo_hookean, young_modulus: 6.0e3, poisson_ratio: 0.45, density: 1060}
    supports: [{select: {plane: {axis: z, at: 0}}}]
)" + organ + R"(
instruments:
  - name: probe
    urdf: )" + test::sourceFolder() + R"(/config/instruments/probe.urdf
    base: {position: [0, 0, 0.1]}
    control_frame: tip
)" + extra);
  }
  scene::Scene scene(const std::string& extra = "") const { return scene::readScene(file(extra)); }

  /// Down 10 mm into the slab, aside and up, at 100 Hz for 1.5 s: joints x y z roll pitch yaw.
  static std::vector<Eigen::VectorXd> press() {
    std::vector<Eigen::VectorXd> joints;
    for (int k = 0; k <= 150; ++k) {
      const double t = 0.01 * k;
      Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
      q[0] = 0.02 * std::clamp(t - 0.5, 0.0, 0.5);
      q[2] = -0.05 - 0.03 * std::min(t, 0.5) + 0.04 * std::max(t - 1.0, 0.0);
      joints.push_back(q);
    }
    return joints;
  }

  const TempFolder& folder() const { return folder_; }

 private:
  TempFolder folder_;
};

/// Carries a surface cut once, after few presses of elements of 15 mm.
inline void beEnriched(const std::string& detail, scene::Scene* scene) {
  tissue::EnrichedSettings& enriched = scene->organs[0].enriched;
  scene->organs[0].model = "enriched";
  enriched.detail = detail;
  enriched.plan.samples = 6;
  enriched.plan.triangles = 120;
  enriched.plan.splits = 1;
  enriched.plan.edge_length = 0.015;
  enriched.plan.press.force = 0.3;
}

/// A sheet of rubber in the place of that slab, held along two edges; or rolled up below the probe,
/// held along one, in a medium in which it unrolls slowly.
inline void beASheet(const std::string& scheme, bool rolled, scene::Scene* scene) {
  scene::OrganConfig& organ = scene->organs[0];
  organ.model = "cloth";
  organ.tetrahedra.clear();
  organ.springs.scheme = scheme;
  organ.cloth.thickness = 1e-3;
  organ.cloth.width = organ.cloth.length = 0.1;
  organ.cloth.spacing = 0.005;
  organ.material.constants = {{"young_modulus", {1e6}}, {"poisson_ratio", {0.3}}};
  organ.damping = {20.0, 0.0};
  organ.pose.position = Vec3(-0.05, -0.05, 0.04);
  organ.supports.resize(1);
  organ.supports[0].select = mesh::BoxRegion{Vec3(-1.0, -1.0, -1.0), Vec3(1.0, 0.005, 1.0)};
  scene->solver.max_newton_iterations = 60;
  if (rolled) {
    scene->gravity.setZero();
    organ.pose.position = Vec3(-0.05, 0.0, 0.02);
    organ.cloth.rolled.emplace();
    organ.cloth.rolled->radius = 0.014;
    organ.damping.mass = 500.0;
    return;
  }
  organ.supports.push_back(organ.supports[0]);
  organ.supports[1].select = mesh::BoxRegion{Vec3(-1.0, 0.094, -1.0), Vec3(1.0, 1.0, 1.0)};
}

}  // namespace palpate::test
