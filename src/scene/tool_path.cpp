// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool_path.h"

#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/number.h"
#include "palpate/base/resource.h"
#include "palpate/formats/trajectory.h"
#include "palpate/instrument/instrument.h"
#include "palpate/instrument/joint_mapper.h"
#include "way_corners.h"

namespace palpate::scene {
namespace {

constexpr double kDeviation = 0.1;   // over the finest edge
constexpr double kFarthest = 100.0;  // from the organ [m]
constexpr std::size_t kMostCorners = 20000;

const InstrumentConfig& findInstrument(const Scene& scene, const std::string& name,
                                       const std::string& key) {
  std::vector<std::string> names;
  for (const InstrumentConfig& instrument : scene.instruments) {
    if (instrument.name == name) return instrument;
    names.push_back(instrument.name);
  }
  if (name.empty() && names.size() == 1) return scene.instruments.front();
  throw InputError(
      scene.file, key + ".instrument", name,
      names.empty() ? "there is no instrument in the scene" : "must be one of " + joinNames(names));
}

std::string resolveUri(const Scene& scene, const std::string& uri, const std::string& key) {
  try {
    return resolveResource(uri, std::filesystem::path(scene.file).parent_path().string());
  } catch (const std::invalid_argument& error) {
    throw InputError(scene.file, key, uri, error.what());
  }
}

// Accepts columns `joint` and `instrument/joint`.
std::vector<std::string> jointNames(std::vector<std::string> columns, const std::string& tool) {
  const std::string prefix = tool + "/";
  for (std::string& column : columns) {
    if (column.rfind(prefix, 0) == 0) column.erase(0, prefix.size());
  }
  return columns;
}

}  // namespace

mesh::Polyline toolPath(const Scene& scene, const OrganConfig& organ, std::size_t index) {
  const RefinementZoneConfig& place = organ.edge_length.near[index];
  const std::string key =
      "organ " + organ.name + ".edge_length.near[" + std::to_string(index) + "]";
  const InstrumentConfig& config = findInstrument(scene, place.instrument, key);
  instrument::InstrumentOptions options;
  options.collision_meshes.convex_hull = true;  // fast; shapes do not matter here
  const instrument::Instrument tool = instrument::readInstrument(
      resolveUri(scene, config.urdf, "instrument " + config.name + ".urdf"), options);
  const int link = tool.linkIndex(config.control_frame);
  if (link < 0) {
    throw InputError(scene.file, "instrument " + config.name + ".control_frame",
                     config.control_frame, "must be a link of " + config.urdf);
  }
  const std::string file = resolveUri(scene, place.trajectory, key + ".trajectory");
  const formats::Trajectory table = formats::readTrajectory(file);
  const std::vector<std::string> columns = jointNames(table.columns, config.name);
  instrument::JointMapper mapper(tool.jointNames());
  const Pose X_OB = organ.pose.pose().inverse() * config.base.pose();
  Eigen::VectorXd q(static_cast<Eigen::Index>(tool.joints().size()));
  std::vector<Pose> X_BL;
  std::vector<Vec3> points;
  for (std::size_t row = 0; row < table.t.size(); ++row) {
    const auto positions = table.values.col(static_cast<Eigen::Index>(row));
    const auto status = mapper.map(columns, positions.data(), columns.size(), &q);
    if (!status.ok()) throw InputError(file, "", "", status.problem);
    tool.linkPoses(q, &X_BL);
    points.push_back(X_OB * X_BL[static_cast<std::size_t>(link)].translation());
    if (points.back().norm() <= kFarthest) continue;
    throw InputError(file, "t = " + formatNumber(table.t[row]), "",
                     "must not lead the tool farther than 100 m from the organ");
  }
  mesh::Polyline path{wayCorners(points, kDeviation * place.finest)};
  if (path.points.size() <= kMostCorners) return path;
  throw InputError(scene.file, key + ".trajectory", place.trajectory,
                   "must be a way of at most " + std::to_string(kMostCorners) +
                       " corners, as seen with a tenth of `finest`");
}

}  // namespace palpate::scene
