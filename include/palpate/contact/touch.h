// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "palpate/contact/obstacle.h"
#include "palpate/contact/signed_distance.h"

namespace palpate::contact {

/// Two unit tangents t1, t2 of the unit vector n, with t1 x t2 = n: a continuous function of n but
/// at n_z = 0 [Duff et al. 2017, Building an orthonormal basis, revisited].
Eigen::Matrix<double, 3, 2> tangents(const Vec3& n);

/// Kinematics of a contact pair: a sample of the tissue's surface and an obstacle.
/// A Response computes energy and force from a Touch.
struct Touch {
  int sample;    ///< Index of the surface sample; < 0: a ball of the obstacle on a triangle.
  int obstacle;  ///< Index among the posed obstacles.
  int number;    ///< Index among all obstacles of the cycle: Obstacle::number.
  Eigen::Vector3i nodes;       ///< Corners of the triangle with the sample.
  Vec3 weights;                ///< Barycentric coordinates of the sample, >= 0, sum 1.
  double area;                 ///< Rest area of the sample [m^2].
  Vec3 offset = Vec3::Zero();  ///< See SurfaceSample.
  double radius;               ///< Inscribed radius of the obstacle [m].
  double room;  ///< Upper bound of the penetration [m]; for samples the inscribed radius.
  /// Young's modulus of the tissue around the sample over the mean edge length [Pa/m]; 0: unknown.
  double bearing = 0.0;

  // Set only for Response::learn().
  double inertia = 0.0;  ///< Mass at the sample over the squared step [N/m].
  double travel = 0.0;   ///< Displacement in the step relative to the mean of all nodes [m].

  double gap;  ///< Signed distance [m], negative inside the obstacle.
  Vec3 p_W;    ///< Position of the sample, world [m].
  Vec3 p_G;    ///< Position of the sample, frame G of the obstacle [m].

  // The frame.
  Mat3 R_WG;
  Vec3 normal_W;     ///< Direction of the gap's gradient, from the obstacle into the tissue, unit,
                     ///< world.
  Vec3 normal_G;     ///< The same normal in frame G.
  double steepness;  ///< Norm of the gap's gradient [-]; 1 except for sampled surfaces.
  Mat3 curvature_G;  ///< Second derivative of the gap by p_G [1/m].

  /// Displacement of the sample in the step relative to the obstacle, which moves and rotates [m].
  Vec3 motion_W;

  double penetration() const { return -gap; }
  /// Nodal vectors `d`, 3 x n, interpolated to the sample.
  Vec3 of(const Points& d) const {
    return weights[0] * d.col(nodes[0]) + weights[1] * d.col(nodes[1]) +
           weights[2] * d.col(nodes[2]);
  }
  /// Mean edge length of the sample's triangle at x [m].
  double meanEdge(const Points& x) const {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) sum += (x.col(nodes[(k + 1) % 3]) - x.col(nodes[k])).norm();
    return sum / 3.0;
  }
  Eigen::Matrix<double, 3, 2> frameTangents() const { return tangents(normal_W); }
  /// Tangential part of motion_W, in world and along frameTangents() [m].
  Vec3 slipInWorld() const { return motion_W - normal_W * normal_W.dot(motion_W); }
  Eigen::Vector2d slip() const { return frameTangents().transpose() * motion_W; }
};

/// An obstacle with its poses at begin and end of a step, which measures touches.
class PosedObstacle {
 public:
  /// `margin` [m]: offset of the contact surface from the shape; half the thickness of a sheet.
  explicit PosedObstacle(const Obstacle& obstacle, double margin = 0.0);

  /// Sets the pose at the step's end.
  /// @pre `obstacle` has the same geometry.
  void move(const Obstacle& obstacle);
  /// Sets the pose at the step's begin to the pose at the end.
  void beginHere();

  const Obstacle& obstacle() const { return obstacle_; }
  double radius() const { return radius_; }
  double margin() const { return margin_; }
  Vec3 toObstacle(const Vec3& p_W) const { return X_GW_ * p_W; }

  /// Signed distance of the point `p_W` from the shape, minus the margin [m].
  double gap(const Vec3& p_W) const {
    return signedDistanceValue(*obstacle_.geometry, X_GW_ * p_W) - margin_;
  }
  /// Writes p_W, p_G, gap, radius, room and number of `touch`.
  void measureGap(const Vec3& p_W, Touch* touch) const {
    touch->p_W = p_W;
    touch->p_G = X_GW_ * p_W;
    touch->gap = signedDistanceValue(*obstacle_.geometry, touch->p_G) - margin_;
    touch->radius = touch->room = radius_;
    touch->number = obstacle_.number;
  }
  /// Writes the frame of `touch`.
  /// @pre measureGap().
  void measureFrame(Touch* touch) const;
  /// Writes motion_W of a sample that was at `p_begin_W` [m] at the step's begin.
  /// @pre measureGap().
  void measureMotion(const Vec3& p_begin_W, Touch* touch) const;

 private:
  Obstacle obstacle_;
  double margin_, radius_;
  Pose X_GW_, X_GW_begin_;
};

}  // namespace palpate::contact
