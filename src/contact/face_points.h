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

/// Balls of thin and sharp tools (faceBalls()) against the triangles of a tissue's surface: what
/// samples of the surface do not meet that are farther apart than the tool is thick. A ball of
/// radius r with its centre at the distance D from a triangle has the gap D - r; it touches all
/// triangles that are nearer than r, each for itself, so that the energy is smooth where it slides
/// from one to the next or lies between several. The nearest of them knows its side: behind it D is
/// negative, and it alone is touched.
class FacePoints {
 public:
  /// `x`: points at rest, 3 x n [m]; `triangles`: the surface, outward; `spacing`: of the samples,
  /// as sampleSurface() has it.
  void setSurface(const Points& X, const Eigen::Matrix3Xi& triangles, double spacing);
  bool empty() const { return triangles_.cols() == 0; }

  /// The obstacles are others now.
  void setObstacles(const std::vector<PosedObstacle>& posed);

  /// How far apart the samples are now on a triangle, at most [m].
  double sampleSpacing(int triangle, const Points& x) const;
  /// Samples that far apart [m] are met by the balls of an obstacle as well,
  bool usesBalls(int obstacle, double spacing) const {
    return spacing > shapes_[static_cast<std::size_t>(obstacle)]->resolution;
  }
  /// and by them alone.
  bool usesBallsOnly(int obstacle, double spacing) const {
    return spacing > shapes_[obstacle]->too_coarse;
  }

  /// The obstacles are the same ones, elsewhere.
  void moveObstacles() { forget(); }

  /// Whether triangles that are too far to matter are left out, as they are by default.
  void setSkip(bool far) {
    skip_far_ = far;
    forget();
  }

  void clear();
  /// Takes as candidates the balls of obstacle b that are less than `reach` [m] from triangles at
  /// x. All of them, or none: which is nearest knows the side.
  void findCandidates(const Points& x, const std::vector<PosedObstacle>& posed, int b,
                      double reach);
  int numCandidates() const { return static_cast<int>(candidates_.size()); }
  bool hasCandidates(int obstacle) const;
  /// visit(node) of all triangles of candidates.
  template <class Visit>
  void forNodes(const Visit& visit) const {
    for (const int t : used_) {
      for (int k = 0; k < 3; ++k) visit(triangles_(k, t));
    }
  }

  /// A ball near a triangle.
  struct BallTrianglePair {
    TrianglePoint near;  ///< Of the triangle, to the ball's centre.
    double distance;     ///< To there, negative behind the nearest triangle [m].
    bool touched;        ///< Not so behind the nearest, but for itself.
    Vec3 direction;      ///< Unit, from there to the centre, or opposite behind it.
    double edge;         ///< Of the triangle, on average, when it was found [m].
    int triangle;
    int first;  ///< The triangle that was the nearest when the ball was found.
  };
  Eigen::Vector3i nodesOf(int triangle) const { return triangles_.col(triangle); }
  /// visit(&touch, pair) of all candidates whose gap is less than `reach` [m]; the touch is
  /// whole but for its motion.
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
  /// Of each ball with candidates: visit(obstacle, radius [m], pair) with the nearest triangle.
  template <class Visit>
  void forBalls(const Points& x, const std::vector<PosedObstacle>& posed,
                const Visit& visit) const {
    measureAt(x);
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const Measured& known = measured(x, posed, g, 0.0);
      visit(groups_[g].obstacle, ball(groups_[g]).radius, pairs_[known.nearest]);
    }
  }
  /// A factor for d, 3 x n [m], with which no triangle goes deeper over a ball's centre than
  /// kFollow of its edge; at most `largest`.
  double maxStep(const Points& x, const Points& d, const std::vector<PosedObstacle>& posed,
                 double largest) const;

  /// Of a triangle's edge: so far a ball may be behind it for the surface to be brought back.
  static constexpr double kFollow = 0.25;

 private:
  struct Shape {
    const instrument::Geometry* of;  // an instrument's; null: bone,
    std::size_t kind;                // and what it is, if another one took its place
    double inscribed, bounding;
    std::vector<TouchBall> balls;  // by their place along `axis`
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
    double apart;  // of the candidate, when it was found [m]
    int candidate, triangle;
  };
  struct Group {
    int obstacle, ball, begin, end;  // of its candidates
    double area;                     // that it stands for [m^2]
    int first;                       // the triangle that was nearest when they were found,
    double edge;                     // and how long its edges were, on average [m]
    // When they were found: whether it was behind the nearest, how far from there [m], and where.
    bool behind;
    double apart;
    Vec3 center_W;
    int nearest;  // triangle, when it was asked for last
  };

  struct Measured {                   // of a group, at x:
    double within;                    // triangles that are nearer [m] are among
    std::size_t begin, end, nearest;  // these of pairs_
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
  // More than what counts as equally near [m].
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
  std::vector<Ordered> by_distance_;  // in each group the near ones first
  Points found_at_;                   // x, when they were found,
  mutable double moved_ = 0.0;        // and how far a corner is from there now, at most [m]
  mutable Eigen::Matrix4Xd around_;   // of each triangle in use: middle and radius of a ball [m],
  mutable Points normals_;            // and unit, outward,
  mutable Points planes_;             // likewise, or zero where they are too flat
  mutable Eigen::VectorXd ways_;      // and how far a corner is to go [m],
  mutable std::vector<std::pair<int, double>> close_;  // of a group, with the least distance
  // Energy, forces, stiffness and the longest step are asked for one after another at the same x.
  mutable bool measured_anywhere_ = false;
  mutable Points measured_at_;
  mutable std::vector<Measured> measured_;
  mutable std::vector<BallTrianglePair> pairs_;
};

}  // namespace palpate::contact
