// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool_distance.h"

#include <algorithm>
#include <limits>

#include "palpate/contact/signed_distance.h"

namespace palpate::tissue {

bool ToolDistance::look(const std::vector<contact::Obstacle>& obstacles, const Points& x,
                        double far) {
  tools_.clear();
  for (const contact::Obstacle& obstacle : obstacles) {
    tools_.push_back({obstacle.geometry, obstacle.X_WG_end, obstacle.X_WG_end.inverse()});
  }
  bool moved = suited_.size() != tools_.size();
  for (std::size_t k = 0; k < tools_.size() && !moved; ++k) {
    moved = contact::sweepLength(*tools_[k].geometry, suited_[k], tools_[k].X_WG) > motion_;
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

void ToolDistance::suited() {
  suited_.clear();
  for (const Tool& tool : tools_) suited_.push_back(tool.X_WG);
}

void ToolDistance::save(StateWriter* out) const {
  Eigen::MatrixXd poses(12, static_cast<Eigen::Index>(suited_.size()));
  for (std::size_t k = 0; k < suited_.size(); ++k) {
    const Eigen::Matrix<double, 3, 4> pose = suited_[k].affine();
    poses.col(static_cast<Eigen::Index>(k)) = pose.reshaped();
  }
  out->put(poses);
}

void ToolDistance::restore(StateReader* in) {
  Eigen::MatrixXd poses;
  in->get(&poses);
  if (poses.rows() != 12) StateReader::fail();
  suited_.assign(static_cast<std::size_t>(poses.cols()), Pose::Identity());
  for (std::size_t k = 0; k < suited_.size(); ++k) {
    suited_[k].affine() = poses.col(static_cast<Eigen::Index>(k)).reshaped(3, 4);
  }
}

}  // namespace palpate::tissue
