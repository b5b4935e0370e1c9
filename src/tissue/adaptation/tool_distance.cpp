// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool_distance.h"

#include <algorithm>
#include <limits>

#include "palpate/contact/signed_distance.h"

namespace palpate::tissue {
namespace {

// Displacements over `motion`: below the first a tool rests, and then the second counts [-].
constexpr double kRests = 0.02, kCountsAtRest = 0.15;

void put(const std::vector<Pose>& poses, StateWriter* out) {
  Eigen::MatrixXd values(12, static_cast<Eigen::Index>(poses.size()));
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Eigen::Matrix<double, 3, 4> pose = poses[k].affine();
    values.col(static_cast<Eigen::Index>(k)) = pose.reshaped();
  }
  out->put(values);
}

std::vector<Pose> getPoses(StateReader* in) {
  Eigen::MatrixXd values;
  in->get(&values);
  if (values.rows() != 12) StateReader::fail();
  std::vector<Pose> poses(static_cast<std::size_t>(values.cols()), Pose::Identity());
  for (std::size_t k = 0; k < poses.size(); ++k) {
    poses[k].affine() = values.col(static_cast<Eigen::Index>(k)).reshaped(3, 4);
  }
  return poses;
}

}  // namespace

Pose ToolDistance::ahead(const contact::Obstacle& obstacle, double cycles) const {
  const Pose &begin = obstacle.X_WG_begin, &end = obstacle.X_WG_end;
  const double way = contact::sweepLength(*obstacle.geometry, begin, end);
  if (way == 0.0) return end;
  return contact::interpolate(begin, end, 1.0 + std::min(cycles, most_ahead_ / way));
}

bool ToolDistance::look(const std::vector<contact::Obstacle>& obstacles, double cycles,
                        const Points& x, double far, double coarsening) {
  const double motion = coarsening * motion_;
  tools_.resize(obstacles.size());
  takeShapes(obstacles);
  for (std::size_t k = 0; k < tools_.size(); ++k) {
    tools_[k].X_WG = ahead(obstacles[k], cycles);
    tools_[k].X_GW = tools_[k].X_WG.inverse();
  }
  bool moved = suited_.size() != tools_.size();
  for (std::size_t k = 0; k < tools_.size() && !moved; ++k) {
    const instrument::Geometry& geometry = *tools_[k].geometry;
    const Pose& X_WG = tools_[k].X_WG;
    const bool rests =
        contact::sweepLength(geometry, obstacles[k].X_WG_end, X_WG) < kRests * motion;
    moved =
        contact::sweepLength(geometry, suited_[k], X_WG) > (rests ? kCountsAtRest : 1.0) * motion;
  }
  if (!moved || tools_.empty()) return false;
  if (far == 0.0) return true;
  const Vec3 low = x.rowwise().minCoeff(), high = x.rowwise().maxCoeff();
  return std::any_of(tools_.begin(), tools_.end(), [&](const Tool& tool) {
    const Vec3 p = tool.X_WG.translation();
    const double gap = (p - p.cwiseMax(low).cwiseMin(high)).norm();
    return gap < far + contact::boundingRadius(*tool.geometry);
  });
}

double ToolDistance::distance(const Vec3& p) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Tool& tool : tools_) {
    least = std::min(least, contact::signedDistanceValue(*tool.geometry, tool.X_GW * p));
  }
  return least;
}

std::vector<Pose> ToolDistance::poses() const {
  std::vector<Pose> poses;
  for (const Tool& tool : tools_) poses.push_back(tool.X_WG);
  return poses;
}

void ToolDistance::suited() { suited_ = poses(); }

void ToolDistance::save(StateWriter* out) const { put(suited_, out); }
void ToolDistance::restore(StateReader* in) { suited_ = getPoses(in); }

void ToolDistance::saveTools(StateWriter* out) const { put(poses(), out); }

void ToolDistance::restoreTools(StateReader* in) {
  tools_.clear();
  for (const Pose& pose : getPoses(in)) tools_.push_back({nullptr, nullptr, pose, pose.inverse()});
}

void ToolDistance::takeShapes(const std::vector<contact::Obstacle>& obstacles) {
  tools_.resize(std::min(tools_.size(), obstacles.size()));
  for (std::size_t k = 0; k < tools_.size(); ++k) {
    if (tools_[k].geometry && tools_[k].of == obstacles[k].geometry) continue;
    tools_[k].of = obstacles[k].geometry;
    tools_[k].geometry = std::make_shared<const instrument::Geometry>(*obstacles[k].geometry);
  }
}

}  // namespace palpate::tissue
