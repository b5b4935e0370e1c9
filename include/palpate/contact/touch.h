// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "palpate/contact/obstacle.h"
#include "palpate/contact/signed_distance.h"

namespace palpate::contact {

/// Two unit tangents t1, t2 of the unit vector n, with t1 x t2 = n: a continuous function of n but
/// at n_z = 0 [Duff et al. 2017, Building an orthonormal basis, revisited].
Eigen::Matrix<double, 3, 2> tangents(const Vec3& n);

/// What a point of the tissue's surface and an obstacle are to each other: geometry and motion
/// alone. What answers it is a Response.
struct Touch {
  int sample;    ///< Of the tissue's surface; below 0 a ball of the obstacle on a triangle.
  int obstacle;  ///< Among those that are posed,
  int number;    ///< and among all of the cycle: Obstacle::number.
  Eigen::Vector3i nodes;       ///< The sample lies between them,
  Vec3 weights;                ///< with these barycentric coordinates.
  double area;                 ///< Rest area that it stands for [m^2].
  Vec3 offset = Vec3::Zero();  ///< See SurfaceSample.
  double radius;               ///< Inscribed, of the obstacle [m].
  double room;  ///< A depth that is never to be reached [m]: the radius, for samples.
  /// Young's modulus of the tissue around, over the length of an edge [Pa/m]; 0: not known.
  double bearing = 0.0;

  // Known where a response learns.
  double inertia = 0.0;  ///< Mass that the sample moves, over the square of the step [N/m].
  double travel = 0.0;   ///< How far in the step, beside the mean of all nodes [m].

  double gap;  ///< Signed distance [m], negative inside the obstacle.
  Vec3 p_W;    ///< The sample [m].
  Vec3 p_G;    ///< The same in the obstacle's frame G.

  // The frame.
  Mat3 R_WG;
  Vec3 normal_W;     ///< Direction of the gap's gradient: unit, from the obstacle into the tissue.
  Vec3 normal_G;     ///< The same in G.
  double steepness;  ///< Length of the gap's gradient: 1 but for sampled surfaces.
  Mat3 curvature_G;  ///< Second derivative of the gap by p_G [1/m].

  /// How the sample has gone past the point of the obstacle where it was when the step began, the
  /// obstacle's own motion and turning included [m].
  Vec3 motion_W;

  double penetration() const { return -gap; }
  /// Of the nodes' d, 3 x n, what it is at the sample.
  Vec3 of(const Points& d) const {
    return weights[0] * d.col(nodes[0]) + weights[1] * d.col(nodes[1]) +
           weights[2] * d.col(nodes[2]);
  }
  /// Of the triangle [m].
  double meanEdge(const Points& x) const {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) sum += (x.col(nodes[(k + 1) % 3]) - x.col(nodes[k])).norm();
    return sum / 3.0;
  }
  Eigen::Matrix<double, 3, 2> frameTangents() const { return tangents(normal_W); }
  /// The tangential part of the motion: in world, and along frameTangents() [m].
  Vec3 slipInWorld() const { return motion_W - normal_W * normal_W.dot(motion_W); }
  Eigen::Vector2d slip() const { return frameTangents().transpose() * motion_W; }
};

/// An obstacle where its way ends, and from where touches with it are measured.
class PosedObstacle {
 public:
  /// `margin` [m]: so far outside of the shape its surface is, for samples in the middle of a sheet
  /// that is twice as thick.
  explicit PosedObstacle(const Obstacle& obstacle, double margin = 0.0);

  /// Where the way ends now; of the same shape.
  void move(const Obstacle& obstacle);
  /// The way begins where it ended.
  void beginHere();

  const Obstacle& obstacle() const { return obstacle_; }
  double radius() const { return radius_; }
  double margin() const { return margin_; }
  Vec3 toObstacle(const Vec3& p_W) const { return X_GW_ * p_W; }

  /// Signed distance of a point that is given in world [m].
  double gap(const Vec3& p_W) const {
    return signedDistanceValue(*obstacle_.geometry, X_GW_ * p_W) - margin_;
  }
  /// Fills p_W, p_G, gap, radius, room and number.
  void measureGap(const Vec3& p_W, Touch* touch) const {
    touch->p_W = p_W;
    touch->p_G = X_GW_ * p_W;
    touch->gap = signedDistanceValue(*obstacle_.geometry, touch->p_G) - margin_;
    touch->radius = touch->room = radius_;
    touch->number = obstacle_.number;
  }
  /// Fills the frame; the gap is measured.
  void measureFrame(Touch* touch) const;
  /// Fills the motion of a sample that was at `p_begin_W` [m] when the way began; the gap is
  /// measured.
  void measureMotion(const Vec3& p_begin_W, Touch* touch) const;

 private:
  Obstacle obstacle_;
  double margin_, radius_;
  Pose X_GW_, X_GW_begin_;
};

}  // namespace palpate::contact
