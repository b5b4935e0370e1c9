// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/contact/touch.h"
#include "palpate/contact/touch_balls.h"
#include "palpate/contact/triangle_distance.h"

namespace palpate::contact {

/// Contact of tool balls (faceBalls()) with surface triangles, for tools thinner than the sample
/// spacing. A ball of radius r at distance D from a triangle has the gap D - r. It touches each
/// triangle nearer than r, so that the energy is smooth from one to the next. The nearest triangle
/// decides the side: behind it D is negative, and it alone is touched.
class FacePoints {
 public:
  /// `X`: rest positions, 3 x n [m]; `triangles`: surface, outward; `spacing`: of sampleSurface()
  /// [m].
  void setSurface(const Points& X, const Eigen::Matrix3Xi& triangles, double spacing);
  bool empty() const { return triangles_.cols() == 0; }

  /// Sets the obstacles.
  void setObstacles(const std::vector<PosedObstacle>& posed);

  /// Largest distance of neighbouring samples on a triangle at x [m].
  double sampleSpacing(int triangle, const Points& x) const;
  /// Whether an obstacle's balls are used in addition to samples of this spacing [m].
  bool usesBalls(int obstacle, double spacing) const {
    return spacing > shapes_[static_cast<std::size_t>(obstacle)]->resolution;
  }
  /// Whether an obstacle's balls replace samples of this spacing [m].
  bool usesBallsOnly(int obstacle, double spacing) const {
    return spacing > shapes_[obstacle]->too_coarse;
  }

  /// The poses of the obstacles have changed.
  void moveObstacles() { forget(); }

  /// Switches skipping of far triangles; on by default.
  void setSkip(bool far) {
    skip_far_ = far;
    forget();
  }

  void clear();
  /// Makes candidates of balls of obstacle b and all triangles nearer than `reach` [m] at x. All
  /// are needed, since the nearest decides the side.
  void findCandidates(const Points& x, const std::vector<PosedObstacle>& posed, int b,
                      double reach);
  int numCandidates() const { return static_cast<int>(candidates_.size()); }
  bool hasCandidates(int obstacle) const;
  /// Calls visit(node) for all nodes of the candidates' triangles.
  template <class Visit>
  void forNodes(const Visit& visit) const {
    for (const int t : used_) {
      for (int k = 0; k < 3; ++k) visit(triangles_(k, t));
    }
  }

  /// Kinematics of a ball and a triangle.
  struct BallTrianglePair {
    TrianglePoint near;  ///< Nearest point of the triangle to the ball's centre.
    double distance;     ///< Distance of the centre, negative behind the nearest triangle [m].
    bool touched;    ///< Whether the ball touches this triangle; behind the nearest, only that one.
    Vec3 direction;  ///< Unit vector from `near` to the centre, reversed behind.
    double edge;     ///< Mean edge of the triangle when it became a candidate [m].
    int triangle;
    int first;  ///< Nearest triangle when the ball became a candidate.
  };
  Eigen::Vector3i nodesOf(int triangle) const { return triangles_.col(triangle); }
  /// Calls visit(&touch, pair) for all candidates with a gap below `reach` [m]; motion_W is not
  /// set.
  template <class Visit>
  void forEach(const Points& x, const std::vector<PosedObstacle>& posed, double reach,
               const Visit& visit) const {
    measureAt(x);
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const Group& group = groups_[g];
      if (staysAway(posed, group, reach + ball(group).radius)) continue;
      const Measured& known = measured(x, posed, g, reach + ball(group).radius);
      for (std::size_t m = known.begin; m < known.end; ++m) {
        const BallTrianglePair& pair = pairs_[m];
        const double gap = pair.distance - ball(group).radius;
        if (!(gap < reach) || !pair.touched) continue;
        Touch touch;
        fill(posed, group, pair, gap, &touch);
        visit(&touch, pair);
      }
    }
  }
  /// Calls visit(obstacle, radius [m], pair) for each ball with its nearest triangle.
  template <class Visit>
  void forBalls(const Points& x, const std::vector<PosedObstacle>& posed,
                const Visit& visit) const {
    measureAt(x);
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const Measured& known = measured(x, posed, g, 0.0);
      visit(groups_[g].obstacle, ball(groups_[g]).radius, pairs_[known.nearest]);
    }
  }
  /// Factor on the step d, 3 x n [m], at most `largest`, so that no triangle passes a ball's centre
  /// by more than kFollow of its edge.
  double maxStep(const Points& x, const Points& d, const std::vector<PosedObstacle>& posed,
                 double largest) const;

  /// Depth of a ball behind a triangle from which contact returns, over the triangle's edge [-].
  static constexpr double kFollow = 0.25;

 private:
  struct Shape {
    const instrument::Geometry* of;  // of an instrument; null: anatomy
    std::size_t kind;                // variant index of the geometry
    double inscribed, bounding;
    std::vector<TouchBall> balls;  // sorted along `axis`
    int axis;
    double largest;                 // radius of a ball [m]
    double resolution, too_coarse;  // distances of samples [m], see usesBalls(), usesBallsOnly()
  };
  struct Near {  // a triangle, with a ball around it
    int triangle;
    Vec3 middle_G;
    double radius;
    double edge;  // on average [m]
  };
  struct Candidate {
    int triangle;
    // When it was found: its mean edge, and how far from it the ball's centre was [m].
    double edge, apart;
  };
  struct Ordered {
    double apart;  // distance when found [m]
    int candidate, triangle;
  };
  struct Group {
    int obstacle, ball, begin, end;  // of its candidates
    double area;                     // area of the ball [m^2]
    int first;                       // nearest triangle when found
    double edge;                     // mean edge of that triangle [m]
    // When found: whether behind the nearest triangle, the distance [m], and the centre.
    bool behind;
    double apart;
    Vec3 center_W;
    int nearest;  // nearest triangle in the last call
  };

  struct Measured {                   // of a group, at x:
    double within;                    // triangles nearer than this [m] are included
    std::size_t begin, end, nearest;  // range in pairs_
  };

  const Shape* shapeOf(const Obstacle& obstacle);
  void findPairs(const Shape& shape, double reach);
  const TouchBall& ball(const Group& g) const { return shapes_[g.obstacle]->balls[g.ball]; }
  Mat3 corners(const Points& x, int triangle) const;
  void order(const Group& group);
  Vec3 centerOf(const std::vector<PosedObstacle>& posed, const Group& group) const {
    return posed[group.obstacle].obstacle().X_WG_end * ball(group).center_G;
  }
  bool staysAway(const std::vector<PosedObstacle>& posed, const Group& group, double within) const;
  void placeTriangles(const Points& x) const;
  // How far the triangle is from there, at least, or more than `far`: it lies in the disc in which
  // its plane cuts the ball around it. Deep in the tissue the ball alone would let most of the
  // surface be the nearest.
  double leastDistance(const Vec3& center, int triangle, double far) const {
    constexpr double kOffPlane = 1e-8;  // so near to it its corners are [of the radius]
    const auto around = around_.col(triangle);
    const Vec3 way = center - around.head<3>();
    const double radius = around[3], squared = way.squaredNorm();
    if (squared > (far + radius) * (far + radius)) return kFarther;
    const double height = planes_.col(triangle).dot(way);
    const double up = std::max(0.0, std::abs(height) - kOffPlane * radius);
    if (up > far) return kFarther;
    const double across =
        std::max(0.0, std::sqrt(std::max(0.0, squared - height * height)) - radius);
    return std::sqrt(up * up + across * across);
  }
  static constexpr double kFarther = std::numeric_limits<double>::infinity();
  // Tolerance for equal distances [m].
  static double withSlack(double distance) { return distance * (1.0 + 1e-8) + 1e-12; }
  void findNear(const Points& x, const Vec3& center, const Group& group, double within) const;
  void forget() { measured_anywhere_ = false; }
  void measureAt(const Points& x) const;
  const Measured& measured(const Points& x, const std::vector<PosedObstacle>& posed,
                           std::size_t group, double within) const;
  Measured measure(const Points& x, const std::vector<PosedObstacle>& posed, Group* group,
                   double within) const;
  BallTrianglePair measurePair(const Vec3& center, const Mat3& corners, int candidate,
                               double* across) const;
  void fill(const std::vector<PosedObstacle>& posed, const Group& group,
            const BallTrianglePair& pair, double gap, Touch* touch) const;

  Eigen::Matrix3Xi triangles_;
  Eigen::VectorXd areas_;      // at rest [m^2]
  Eigen::VectorXi divisions_;  // of the longest edge, by samples
  std::vector<std::unique_ptr<const Shape>> known_;
  std::vector<const Shape*> shapes_;  // of the obstacles
  std::vector<Candidate> candidates_;
  mutable std::vector<Group> groups_;
  std::vector<Near> near_;
  std::vector<std::pair<int, int>> found_;  // balls, and triangles in near_;
  std::vector<std::size_t> places_;         // where those of a ball go
  // What is spared: a ball that was in front when it was found, if neither it nor the tissue went
  // as far since; likewise a triangle that was far from it; and balls around the triangles as they
  // are now.
  bool skip_far_ = true;
  std::vector<int> used_;
  std::vector<char> is_used_;
  std::vector<Ordered> by_distance_;  // of each group, ascending
  Points found_at_;                   // positions when found
  mutable double moved_ = 0.0;        // largest displacement of a corner since [m]
  mutable Eigen::Matrix4Xd around_;   // bounding ball of each used triangle: middle and radius [m]
  mutable Points normals_;            // normals, unit, outward
  mutable Points planes_;             // normals, or zero for degenerate triangles
  mutable Eigen::VectorXd ways_;      // largest displacement of a corner in a step [m]
  mutable std::vector<std::pair<int, double>> close_;  // of a group: candidate, least distance
  // Cache of one x: energy, forces, stiffness and step bound are evaluated in sequence.
  mutable bool measured_anywhere_ = false;
  mutable Points measured_at_;
  mutable std::vector<Measured> measured_;
  mutable std::vector<BallTrianglePair> pairs_;
};

}  // namespace palpate::contact
