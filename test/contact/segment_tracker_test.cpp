// SPDX-License-Identifier: GPL-3.0-or-later
// Crossings of a segment with surfaces that move: the tree and the walk against all triangles.
#include "palpate/contact/segment_tracker.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "palpate/organs/organs.h"
#include "support/random.h"

namespace palpate::contact::segment_tracker_test {
namespace {

struct Surface {
  Points X;
  Eigen::Matrix3Xi triangles;
};

Surface organ(const std::string& name, double edge) {
  const mesh::SurfaceMesh mesh = organs::makeOrgan(name, edge);
  return {mesh.points, mesh.triangles};
}

// A ball of 50 mm, of an octahedron with its triangles split in four, and again.
Surface ball(int splits) {
  std::vector<Vec3> points = {Vec3::UnitX(),  -Vec3::UnitX(), Vec3::UnitY(),
                              -Vec3::UnitY(), Vec3::UnitZ(),  -Vec3::UnitZ()};
  std::vector<Eigen::Vector3i> triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                            {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (; splits > 0; --splits) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int i, int j) {
      const auto [at, fresh] = middles.insert({std::minmax(i, j), static_cast<int>(points.size())});
      if (fresh) points.push_back((points[i] + points[j]).normalized());
      return at->second;
    };
    std::vector<Eigen::Vector3i> finer;
    for (const Eigen::Vector3i& t : triangles) {
      const int a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], a, c}, {a, t[1], b}, {c, b, t[2]}, {a, b, c}});
    }
    triangles.swap(finer);
  }
  Surface surface{Points(3, points.size()), Eigen::Matrix3Xi(3, triangles.size())};
  for (std::size_t k = 0; k < points.size(); ++k) surface.X.col(k) = 0.05 * points[k];
  for (std::size_t k = 0; k < triangles.size(); ++k) surface.triangles.col(k) = triangles[k];
  return surface;
}

// By the equations of the segment and each triangle.
std::vector<SegmentHit> ofAll(const Surface& s, const Points& x, const Vec3& begin,
                              const Vec3& end) {
  std::vector<SegmentHit> hits;
  for (int t = 0; t < s.triangles.cols(); ++t) {
    const Vec3 a = x.col(s.triangles(0, t)), b = x.col(s.triangles(1, t)),
               c = x.col(s.triangles(2, t));
    Mat3 A;
    A << b - a, c - a, begin - end;
    const Vec3 u = A.fullPivLu().solve(begin - a);
    const Vec3 weights(1.0 - u[0] - u[1], u[0], u[1]);
    if (!(weights.minCoeff() >= 0.0 && u[2] >= 0.0 && u[2] <= 1.0)) continue;
    hits.push_back({t, weights, u[2], (end - begin).dot((b - a).cross(c - a)) < 0.0});
  }
  std::sort(hits.begin(), hits.end(),
            [](const SegmentHit& a, const SegmentHit& b) { return a.part < b.part; });
  return hits;
}

Vec3 place(const Surface& s, const Points& x, const SegmentHit& hit) {
  Vec3 p = Vec3::Zero();
  for (int k = 0; k < 3; ++k) p += hit.weights[k] * x.col(s.triangles(k, hit.triangle));
  return p;
}

// The same crossing; a line that grazes the surface meets it less exactly.
void expectSame(const Surface& s, const Points& x, const Vec3& d, const SegmentHit& a,
                const SegmentHit& b) {
  EXPECT_EQ(a.triangle, b.triangle);
  EXPECT_EQ(a.inward, b.inward);
  const Eigen::Vector3i t = s.triangles.col(a.triangle);
  const Vec3 n = (x.col(t[1]) - x.col(t[0])).cross(x.col(t[2]) - x.col(t[0])).normalized();
  const double steep = std::abs(n.dot(d.normalized()));
  EXPECT_LT((place(s, x, a) - place(s, x, b)).norm() * steep, 1e-12);
}

// A tool that goes about at random with its tip in the surface, which heaves.
struct Tally {
  int cycles = 0, single = 0, lost_single = 0, other = 0;
};

Tally goAbout(const Surface& s, double motion, unsigned seed) {
  test::Random random(seed);
  SegmentTracker tracker(s.X, s.triangles);
  Tally tally;
  int last = -1;
  Vec3 tip = 0.6 * s.X.col(7) + 0.4 * s.X.rowwise().mean(), handle = tip + Vec3(0, 0, 0.3);
  std::vector<SegmentHit> hits;
  for (int cycle = 0; cycle < 4000; ++cycle) {
    Points x = s.X;
    const double heave = 0.003 * std::sin(0.01 * cycle);
    x.row(2) += (heave * (60.0 * s.X.row(0).array()).sin()).matrix();
    x.row(0) += (heave * (40.0 * s.X.row(1).array()).cos()).matrix();
    if (cycle % 100 == 0) {  // elsewhere
      const auto node = static_cast<Eigen::Index>(cycle * 37 % s.X.cols());
      tip = 0.85 * s.X.col(node) + 0.15 * s.X.rowwise().mean();
      handle =
          tip + 0.3 * (s.X.col(node) - s.X.rowwise().mean() + random.vector(0.02)).normalized();
      last = -1;
    } else {
      tip += random.vector(motion);
      handle += random.vector(motion);
    }
    const std::vector<SegmentHit> all = ofAll(s, x, handle, tip);
    tracker.fit(x);
    tracker.find(x, handle, tip, &hits);
    EXPECT_EQ(hits.size(), all.size()) << cycle;
    for (std::size_t k = 0; k < std::min(hits.size(), all.size()); ++k) {
      expectSame(s, x, tip - handle, hits[k], all[k]);
    }
    if (last >= 0) {
      const std::optional<SegmentHit> walked = tracker.walk(x, handle, tip, last);
      ++tally.cycles;
      tally.single += hits.size() == 1;
      tally.lost_single += hits.size() == 1 && !(walked && walked->part <= 1.0);
      if (walked && walked->part <= 1.0) {
        const auto same = std::find_if(hits.begin(), hits.end(), [&](const SegmentHit& hit) {
          return hit.triangle == walked->triangle;
        });
        EXPECT_NE(same, hits.end()) << cycle;
        if (same != hits.end()) expectSame(s, x, tip - handle, *walked, *same);
        tally.other += same != hits.end() && same + 1 != hits.end();
      }
    }
    last = hits.empty() || !hits.back().inward ? -1 : hits.back().triangle;  // what holds the tip
  }
  const SegmentTracker::Counts& counts = tracker.counts();
  EXPECT_EQ(counts.queries, 4000);
  EXPECT_EQ(counts.walks, tally.cycles);
  std::printf("%ld triangles: %d walks, %ld steps, %ld lost, %d of a single crossing\n",
              static_cast<long>(s.triangles.cols()), tally.cycles, counts.steps, counts.lost,
              tally.lost_single);
  return tally;
}

// On a ball nothing turns away between two places that a short motion apart meet the same side.
TEST(SegmentTracker, FindsAndFollowsWhatAllTrianglesSayOnABall) {
  const Tally tally = goAbout(ball(4), 0.002, 1);
  EXPECT_GT(tally.single, 3000);
  EXPECT_EQ(tally.lost_single, 0);
}

TEST(SegmentTracker, FindsAndFollowsWhatAllTrianglesSayOnALiver) {
  for (const double edge : {0.03, 0.01}) {
    const Tally tally = goAbout(organ("liver", edge), 0.002, 2);
    EXPECT_GT(tally.cycles, 3000);
    EXPECT_LT(tally.lost_single, tally.cycles / 100);  // about the sharp border
  }
}

// Through a node, an edge and the inside of a triangle of a table's top.
TEST(SegmentTracker, MeetsVertexEdgeAndFace) {
  const Surface slab = organ("slab", 0.01);
  SegmentTracker tracker(slab.X, slab.triangles);
  std::vector<SegmentHit> hits;
  const Vec3 up(0.0, 0.0, 0.05);
  int top = 0;
  while (slab.X.row(2).maxCoeff() > slab.X.col(slab.triangles(0, top))[2] ||
         slab.X.row(2).maxCoeff() > slab.X.col(slab.triangles(1, top))[2] ||
         slab.X.row(2).maxCoeff() > slab.X.col(slab.triangles(2, top))[2]) {
    ++top;
  }
  const Vec3 a = slab.X.col(slab.triangles(0, top)), b = slab.X.col(slab.triangles(1, top)),
             c = slab.X.col(slab.triangles(2, top));
  tracker.find(slab.X, a + up, a - 0.2 * up, &hits);
  ASSERT_GE(hits.size(), 1U);  // rounding says of how many around it
  for (const SegmentHit& hit : hits) EXPECT_GT(hit.weights.maxCoeff(), 1.0 - 1e-12);
  const Vec3 m = 0.25 * a + 0.75 * b;
  tracker.find(slab.X, m + up, m - 0.2 * up, &hits);
  ASSERT_GE(hits.size(), 1U);
  for (const SegmentHit& hit : hits) EXPECT_LT(hit.weights.minCoeff(), 1e-12);
  const Vec3 f = 0.5 * a + 0.3 * b + 0.2 * c;
  tracker.find(slab.X, f + up, f - 0.2 * up, &hits);
  ASSERT_EQ(hits.size(), 1U);
  EXPECT_EQ(hits[0].triangle, top);
  EXPECT_TRUE(hits[0].inward);
  EXPECT_LT((hits[0].weights - Vec3(0.5, 0.3, 0.2)).norm(), 1e-12);
  tracker.find(slab.X, f - 0.2 * up, f + up, &hits);
  ASSERT_EQ(hits.size(), 1U);
  EXPECT_FALSE(hits[0].inward);
  const auto before = tracker.walk(slab.X, f + up, f + 0.1 * up, top);  // the segment ends
  ASSERT_TRUE(before);
  EXPECT_NEAR(before->part, 1.0 / 0.9, 1e-12);
  EXPECT_FALSE(tracker.walk(slab.X, f + up + Vec3(1, 0, 0), f - up + Vec3(1, 0, 0), top));
  tracker.find(slab.X, f + up + Vec3(1, 0, 0), f - up + Vec3(1, 0, 0), &hits);
  EXPECT_TRUE(hits.empty());
}

}  // namespace
}  // namespace palpate::contact::segment_tracker_test
