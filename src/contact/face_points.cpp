// SPDX-License-Identifier: GPL-3.0-or-later
#include "face_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "face_balls.h"
#include "palpate/contact/signed_distance.h"
#include "palpate/contact/surface_samples.h"

namespace palpate::contact {
namespace {

// Of a ball's radius and of a triangle's edge: of the larger one an eighth is a depth at which the
// answer becomes hard. Harder, it would be more than Newton's method has iterations for.
constexpr double kRadii = 4.0, kHard = 0.125;

}  // namespace

void FacePoints::setSurface(const Points& X, const Eigen::Matrix3Xi& triangles, double spacing) {
  triangles_ = triangles;
  areas_.resize(triangles.cols());
  divisions_.resize(triangles.cols());
  is_used_.assign(static_cast<std::size_t>(triangles.cols()), 0);
  around_.resize(4, triangles.cols());
  normals_.resize(3, triangles.cols());
  planes_.resize(3, triangles.cols());
  ways_.resize(triangles.cols());
  for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
    const Mat3 at = corners(X, static_cast<int>(t));
    areas_[t] = 0.5 * (at.col(1) - at.col(0)).cross(at.col(2) - at.col(0)).norm();
    const double longest = std::max({(at.col(1) - at.col(0)).norm(), (at.col(2) - at.col(1)).norm(),
                                     (at.col(0) - at.col(2)).norm()});
    divisions_[t] = sampleDivisions(longest, spacing);
  }
}

void FacePoints::clear() {
  candidates_.clear();
  by_distance_.clear();
  groups_.clear();
  for (const int t : used_) is_used_[static_cast<std::size_t>(t)] = 0;
  used_.clear();
  forget();
}

void FacePoints::setObstacles(const std::vector<PosedObstacle>& posed) {
  clear();
  shapes_.clear();
  if (empty()) return;
  for (const PosedObstacle& obstacle : posed) shapes_.push_back(shapeOf(obstacle.obstacle()));
}

// Bones are met by samples: they are not as thin as these are far apart.
const FacePoints::Shape* FacePoints::shapeOf(const Obstacle& obstacle) {
  const bool tool = obstacle.owner.isInstrument();
  const instrument::Geometry& geometry = *obstacle.geometry;
  const instrument::Geometry* of = tool ? &geometry : nullptr;
  const double inscribed = inscribedRadius(geometry), bounding = boundingRadius(geometry);
  for (const std::unique_ptr<const Shape>& shape : known_) {
    if (shape->of != of) continue;
    if (!tool) return shape.get();
    if (shape->kind == geometry.index() && shape->inscribed == inscribed &&
        shape->bounding == bounding) {
      return shape.get();
    }
  }
  constexpr double kNever = std::numeric_limits<double>::infinity();
  Shape shape{of, geometry.index(), inscribed, bounding, {}, 0, 0.0, kNever, kNever};
  if (tool) shape.balls = faceBalls(geometry);
  if (!shape.balls.empty()) {
    shape.resolution = resolutionOf(geometry);
    if (coverAll(geometry)) shape.too_coarse = 2.0 * inscribed;
    Vec3 low = shape.balls.front().center_G, high = low;
    for (const TouchBall& ball : shape.balls) {
      low = low.cwiseMin(ball.center_G);
      high = high.cwiseMax(ball.center_G);
      shape.largest = std::max(shape.largest, ball.radius);
    }
    (high - low).maxCoeff(&shape.axis);
    std::stable_sort(shape.balls.begin(), shape.balls.end(),
                     [axis = shape.axis](const TouchBall& a, const TouchBall& b) {
                       return a.center_G[axis] < b.center_G[axis];
                     });
  }
  known_.push_back(std::make_unique<const Shape>(std::move(shape)));
  return known_.back().get();
}

Mat3 FacePoints::corners(const Points& x, int triangle) const {
  Mat3 corners;
  for (int k = 0; k < 3; ++k) corners.col(k) = x.col(triangles_(k, triangle));
  return corners;
}

double FacePoints::sampleSpacing(int triangle, const Points& x) const {
  const Mat3 at = corners(x, triangle);
  double longest = 0.0;
  for (int k = 0; k < 3; ++k) {
    longest = std::max(longest, (at.col((k + 1) % 3) - at.col(k)).squaredNorm());
  }
  return std::sqrt(longest) / divisions_[triangle];
}

bool FacePoints::hasCandidates(int obstacle) const {
  return std::any_of(groups_.begin(), groups_.end(),
                     [&](const Group& group) { return group.obstacle == obstacle; });
}

void FacePoints::fill(const std::vector<PosedObstacle>& posed, const Group& group,
                      const BallTrianglePair& pair, double gap, Touch* touch) const {
  const int triangle = pair.triangle;
  const Obstacle& obstacle = posed[group.obstacle].obstacle();
  touch->sample = -1 - (group.ball * static_cast<int>(triangles_.cols()) + triangle);
  touch->obstacle = group.obstacle;
  touch->number = obstacle.number;
  touch->nodes = triangles_.col(triangle);
  touch->weights = pair.near.weights;
  touch->area = group.area;
  touch->radius = posed[group.obstacle].radius();
  touch->room = std::max(kRadii * ball(group).radius, kHard * group.edge);
  touch->gap = gap;
  touch->p_W = pair.near.point;
  touch->p_G = posed[group.obstacle].toObstacle(touch->p_W);
  touch->R_WG = obstacle.X_WG_end.linear();
  touch->normal_W = -pair.direction;
  touch->normal_G = touch->R_WG.transpose() * touch->normal_W;
  touch->steepness = 1.0;
  touch->curvature_G.setZero();
  touch->motion_W.setZero();
}

}  // namespace palpate::contact
