// SPDX-License-Identifier: GPL-3.0-or-later
// Where the simulator's tools are, and where they go.
#include <algorithm>
#include <cmath>

#include "palpate/contact/overlap.h"
#include "simulator_impl.h"

namespace palpate::sim {
namespace {

// Where the shapes of a tool stand that is not there: far from any tissue [m].
const Pose kNowhere(Eigen::Translation3d(0.0, 0.0, 1.0e4));

}  // namespace

bool inReach(const LinkPoses& poses) {
  return std::all_of(poses.begin(), poses.end(), [](const Pose& X) {
    return X.matrix().allFinite() && X.translation().stableNorm() <= kReach;
  });
}

bool inReach(const std::vector<LinkPoses>& poses) {
  return std::all_of(poses.begin(), poses.end(),
                     [](const LinkPoses& links) { return inReach(links); });
}

bool Simulator::Impl::accepts(const std::vector<LinkPoses>& next, double dt) const {
  if (!(dt > 0.0) || !std::isfinite(dt) || next.size() != parts.instruments.size()) return false;
  for (std::size_t i = 0; i < next.size(); ++i) {
    if (next[i].empty()) continue;  // it is not there
    if (next[i].size() != parts.instruments[i].linkNames().size()) return false;
  }
  return inReach(next);
}

bool Simulator::Impl::isFree(std::size_t i, const LinkPoses& links) const {
  if (!anatomy.isFree(i, links)) return false;
  for (const instrument::CollisionBody& shape : parts.instruments[i].bodies()) {
    const Pose X_WG = links[shape.link] * shape.X_LG;
    for (const scene::OrganHandle& organ : parts.organs) {
      const tissue::SurfaceState tissue = organ.surfaceState();
      if (contact::overlaps(shape.geometry, X_WG, tissue.positions, tissue.triangles,
                            scene.contact.smoothing)) {
        return false;
      }
    }
  }
  return true;
}

const std::vector<LinkPoses>& Simulator::Impl::follow(const std::vector<LinkPoses>& commanded,
                                                      double dt) {
  next_poses = commanded;
  for (std::size_t i = 0; i < next_poses.size(); ++i) {
    if (!scene.instruments[i].proxy.active) continue;
    if (commanded[i].empty()) {
      proxies[i].leave();
    } else {
      proxies[i].follow(commanded[i], dt, [&](const LinkPoses& at) { return isFree(i, at); });
      next_poses[i] = proxies[i].poses();
    }
  }
  return next_poses;
}

void Simulator::Impl::moveBodies(const std::vector<LinkPoses>& next) {
  for (std::size_t k = 0; k < body_source.size(); ++k) {
    const auto [i, b] = body_source[k];
    const instrument::CollisionBody& shape = parts.instruments[i].bodies()[b];
    contact::Obstacle& body = bodies[k];
    body.X_WG_end = next[i].empty() ? kNowhere : next[i][shape.link] * shape.X_LG;
    // One that was not there has no way: it is where it begins.
    const bool moves = !poses[i].empty() && !next[i].empty();
    body.X_WG_begin = moves ? poses[i][shape.link] * shape.X_LG : body.X_WG_end;
  }
  poses = next;
}

}  // namespace palpate::sim
