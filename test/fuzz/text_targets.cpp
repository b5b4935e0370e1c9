// SPDX-License-Identifier: GPL-3.0-or-later
#include "text_targets.h"

#include "palpate/analysis/case.h"
#include "palpate/formats/trajectory.h"
#include "palpate/instrument/instrument.h"
#include "palpate/scene/scene.h"
#include "palpate/scene/tissue_file.h"
#include "palpate/springs/springs_file.h"
#include "scratch_file.h"
#include "targets.h"

namespace palpate::fuzz {

void readSceneFile(std::string_view bytes) {
  static const ScratchFile file("hostile.yaml");
  const scene::Scene scene = scene::readScene(file.write(bytes));
  require(!scene.organs.empty(), "a scene without organs");
}

void readCaseFile(std::string_view bytes) {
  static const ScratchFile file("hostile.yaml");
  const analysis::Case problem = analysis::readCase(file.write(bytes));
  require(problem.mesh.box.has_value() != !problem.mesh.file.empty(), "a case of no mesh or two");
}

void readTissue(std::string_view bytes) {
  static const ScratchFile file("hostile.yaml");
  const scene::TissueFile tissue = scene::readTissueFile(file.write(bytes));
  const material::Solid solid = scene::makeSolid(tissue.material, tissue.file, "material");
  require(solid.density > 0.0, "a tissue without mass");
}

void readTrajectoryFile(std::string_view bytes) {
  static const ScratchFile file("hostile.csv");
  const formats::Trajectory table = formats::readTrajectory(file.write(bytes));
  require(!table.t.empty() && !table.columns.empty(), "a trajectory of nothing");
  require(table.values.cols() == static_cast<Eigen::Index>(table.t.size()), "rows without a time");
  require(table.values.rows() == static_cast<Eigen::Index>(table.columns.size()), "no columns");
  require(table.values.allFinite(), "a position that is not finite");
  for (std::size_t i = 1; i < table.t.size(); ++i) {
    require(table.t[i] > table.t[i - 1], "a time that goes back");
  }
}

void readSpringsFile(std::string_view bytes) {
  static const ScratchFile file("hostile.csv");
  springs::checkNetwork(springs::readSprings(file.write(bytes)));
}

void readUrdf(std::string_view bytes) {
  static const ScratchFile file("hostile.urdf");
  file.folder().write("part.obj",
                      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const instrument::Instrument tool = instrument::readInstrument(file.write(bytes));
  std::vector<Pose> poses;
  for (const double position : {0.0, 1.0, -100.0}) {
    const auto n = static_cast<Eigen::Index>(tool.joints().size());
    tool.linkPoses(Eigen::VectorXd::Constant(n, position), &poses);
    for (const Pose& X : poses) require(X.matrix().allFinite(), "a link that is nowhere");
  }
  for (const instrument::CollisionBody& body : tool.bodies()) {
    require(body.link >= 0 && body.link < static_cast<int>(poses.size()), "a body of no link");
  }
}

}  // namespace palpate::fuzz
