// SPDX-License-Identifier: GPL-3.0-or-later
// Initial states other than rest.
#include <cmath>

#include "palpate/io/state_file.h"
#include "palpate/torture/draw.h"
#include "palpate/torture/scene_files.h"

namespace palpate::torture {
namespace {

constexpr double kScale = 10.0;

// Displaced positions; held points stay.
Points displaced(const TortureScene& scene, const TortureOrgan& organ, const Points& rest) {
  Draw draw(scene.seed ^ 0x5747a27eULL, static_cast<std::uint64_t>(scene.number));
  const Vec3 middle = organ.low + 0.5 * organ.size, high = organ.low + organ.size;
  Points points = rest;
  for (Eigen::Index i = 0; i < rest.cols(); ++i) {
    const Vec3 X = rest.col(i);
    if (organ.held && X.z() <= organ.heldTo()) continue;
    const double up = X.z() - organ.low.z();
    Vec3 x = X;
    if (scene.start == Start::kRandom) x = draw.within(organ.low, high);
    if (scene.start == Start::kFlat) x.z() = organ.low.z();
    if (scene.start == Start::kInverted) x.z() = organ.low.z() - up;
    if (scene.start == Start::kScaled) x = organ.low + kScale * (X - organ.low);
    if (scene.start == Start::kTwisted) {
      const double angle = static_cast<double>(EIGEN_PI * up / organ.size.z());
      const Eigen::AngleAxisd turn(angle, Vec3::UnitZ());
      x = middle + turn * (X - middle);
    }
    points.col(i) = x;
  }
  return points;
}

void turnGravity(const SceneFiles& files, sim::Simulator* simulator) {
  scene::Scene turned = scene::readScene(files.scene);
  turned.gravity = -turned.gravity;
  sim::Simulator other(turned);
  for (int i = 0; i < simulator->numOrgans(); ++i) {
    const Points& x = other.positions(i);
    simulator->setPositions(i, x, Points::Zero(3, x.cols()));
  }
}

}  // namespace

void writeStart(const TortureScene& scene, const SceneFiles& files, sim::Simulator* simulator) {
  if (scene.start == Start::kTurnedGravity) {
    turnGravity(files, simulator);
  } else if (scene.start == Start::kThrown) {
    const int last = simulator->numOrgans() - 1;
    const Points x = simulator->positions(last);
    Points v = Points::Zero(3, x.cols());
    v.row(2).setConstant(-scene.thrown);
    simulator->setPositions(last, x, v);
  } else {
    for (int i = 0; i < simulator->numOrgans(); ++i) {
      const Points rest = simulator->positions(i);
      simulator->setPositions(i, displaced(scene, scene.organs[static_cast<std::size_t>(i)], rest),
                              Points::Zero(3, rest.cols()));
    }
  }
  io::writeState(files.state, simulator->state());
}

}  // namespace palpate::torture
