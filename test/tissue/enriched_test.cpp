// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dented_block.h"
#include "model_variants.h"
#include "palpate/mesh/surface_points.h"
#include "support/contains.h"
#include "tissue/models/enriched/fine_surface.h"
#include "tissue/models/enriched/learned_detail.h"

namespace palpate::tissue::enriched_test {
namespace {

test::OrganSketch blockOf(const std::string& detail) {
  test::ModelVariant variant{"enriched", "enriched", {}, {}};
  variant.enriched.detail = detail;
  return test::variantBlock(variant);
}

mesh::SurfaceMesh boundaryOf(const mesh::TetMesh& mesh) {
  return {mesh.points, mesh::trianglesOf(mesh::boundaryFaces(mesh))};
}

TEST(FineSurface, LiesAtRestWhereItIsAndMovesWithItsBody) {
  const mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.06, 0.06, 0.03), Eigen::Vector3i(6, 6, 3));
  mesh::SurfaceMesh bulged = test::dentedBlock(mesh).fine;
  bulged.points.row(2).array() += 0.001;  // away from the coarse surface
  const FineSurface fine(boundaryOf(mesh), bulged, 0.004);
  Points on;
  fine.carried(mesh.points, &on);
  EXPECT_LT((on + fine.distance() - bulged.points).norm(), 1e-15);
  const Vec3 way(0.1, -0.2, 0.3);
  fine.carried(mesh.points.colwise() + way, &on);
  EXPECT_LT((on + fine.distance() - (bulged.points.colwise() + way)).norm(), 1e-14);
  double area = 0.0;
  Points offsets;
  fine.offsets(Points::Constant(3, fine.numPoints(), 0.002), &offsets);
  for (std::size_t s = 0; s < fine.samples().size(); ++s) {
    const contact::SurfaceSample& sample = fine.samples()[s];
    area += sample.area;
    const Vec3 more = offsets.col(static_cast<Eigen::Index>(s)) - sample.offset;
    EXPECT_LT((more - Vec3::Constant(0.002)).norm(), 1e-15);
  }
  EXPECT_NEAR(area, 2.0 * 0.06 * 0.06 + 4.0 * 0.06 * 0.03, 1e-12);
}

// A tool that does not touch teaches nothing; two teach what each does.
TEST(LearnedDetail, IsTheSumOverToolsThatTouch) {
  const mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.06, 0.06, 0.03), Eigen::Vector3i(6, 6, 3));
  const enrichment::DeformationDatabase database = test::dentedBlock(mesh);
  const FineSurface fine(boundaryOf(mesh), database.fine, 0.004);
  LearnedDetail learned({}, database, Pose::Identity(), boundaryOf(mesh));
  Points u = Points::Zero(3, mesh.numPoints()), none, one, other, both;
  const Vec3 a(0.01, 0.01, 0.03), b(0.05, 0.05, 0.03);
  for (Eigen::Index i = 0; i < u.cols(); ++i) {
    for (const Vec3& at : {a, b}) {
      const double r = (mesh.points.col(i) - at).norm() / 0.015;
      u(2, i) -= 0.004 * std::exp(-r * r);
    }
  }
  const TissueContact at_a{{0}, 0.001, a, Vec3(0, 0, 0.2), 0},
      at_b{{1}, 0.001, b, Vec3(0, 0, 0.3), 0};
  learned.find({}, u, fine, &none);
  learned.find({at_a}, u, fine, &one);
  learned.find({at_b}, u, fine, &other);
  learned.find({at_a, at_b}, u, fine, &both);
  EXPECT_TRUE(none.isZero(0.0));
  EXPECT_GT(one.norm(), 0.0);
  EXPECT_GT(other.norm(), 0.0);
  EXPECT_LT((both - one - other).norm(), 1e-12 * both.norm());
}

// An organ that is turned as a whole has the same detail, turned.
TEST(LearnedDetail, TurnsWithTheOrgan) {
  const mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.06, 0.06, 0.03), Eigen::Vector3i(6, 6, 3));
  const enrichment::DeformationDatabase database = test::dentedBlock(mesh);
  const Vec3 at(0.03, 0.03, 0.03);
  Points u = Points::Zero(3, mesh.numPoints());
  for (Eigen::Index i = 0; i < u.cols(); ++i) {
    const double r = (mesh.points.col(i) - at).norm() / 0.015;
    u(2, i) = -0.004 * std::exp(-r * r);
  }
  Points details[2];
  const Pose X_WO = poseFromXyzRpy(Vec3(0.3, 0.2, 0.1), Vec3(0.7, -1.1, 2.0));
  for (const std::string detail : {"residual", "displacement"}) {
    for (const bool turned : {false, true}) {
      const Pose X = turned ? X_WO : Pose::Identity();
      const auto placed = [&](const mesh::SurfaceMesh& surface) {
        return mesh::SurfaceMesh{X * surface.points.colwise().homogeneous(), surface.triangles};
      };
      EnrichedSettings settings;
      settings.detail = detail;
      const FineSurface fine(placed(boundaryOf(mesh)), placed(database.fine), 0.004);
      LearnedDetail learned(settings, database, X, placed(boundaryOf(mesh)));
      const TissueContact contact{{0}, 0.001, X * at, X.linear() * Vec3(0, 0, 0.2), 0};
      learned.find({contact}, X.linear() * u, fine, &details[turned]);
    }
    EXPECT_GT(details[0].norm(), 0.0);
    EXPECT_LT((details[1] - X_WO.linear() * details[0]).norm(), 1e-9 * details[0].norm());
  }
}

// Without detail the fine surface lies in the triangles of the coarse one, and what a ball feels
// differs by where its samples are only.
TEST(EnrichedTissue, WithoutDetailFeelsAsItsElementsDo) {
  test::ModelVariant plain{"fem", "fem", {}, {}};
  tissue::ModelSettings settings = test::variantSettings();
  settings.sample_spacing = 0.001;  // both are dense under the ball
  double force[2];
  for (const bool enriched : {false, true}) {
    const test::OrganSketch organ = enriched ? blockOf("none") : test::variantBlock(plain);
    const auto tissue = test::makeOrgans({organ}, settings, nullptr, enriched ? "enriched" : "fem");
    test::Visit visit;
    Vec3 sum = Vec3::Zero();
    while (visit.time() < 0.35) {
      sum.setZero();
      for (const TissueContact& c : tissue->step({visit.next()}, test::kStep).contacts) {
        sum += c.force_W;
      }
    }
    force[enriched] = sum.norm();
  }
  EXPECT_NEAR(force[1], force[0], 0.05 * force[0]);
}

// Detail comes and goes within its time: neither it nor the force jumps, and at the end the fine
// surface is at rest again.
TEST(EnrichedTissue, DetailComesAndGoesSmoothly) {
  for (const std::string detail : {"residual", "displacement"}) {
    test::OrganSketch organ = blockOf(detail);
    organ.enriched.sigma = 5.0;  // its dents are no dents of such a block
    const auto tissue = test::makeOrgans({organ}, test::variantSettings(), nullptr, "enriched");
    const Points rest = tissue->positions();
    const Eigen::Index nodes = organ.mesh.numPoints();
    test::Visit visit;
    double largest = 0.0, fastest = 0.0, before = 0.0, held = 0.0, rough = 0.0;
    const enrichment::DeformationDatabase database = test::dentedBlock(organ.mesh);
    const std::vector<mesh::SurfacePoint> places =
        mesh::nearestSurfacePoints(boundaryOf(organ.mesh), database.fine.points);
    Points now, last = Points::Zero(3, database.numFine());
    while (visit.time() < 2.0) {
      const TissueStep& step = tissue->step({visit.next()}, test::kStep);
      ASSERT_EQ(step.status, solver::SolveStatus::kConverged);
      Vec3 sum = Vec3::Zero();
      for (const TissueContact& c : step.contacts) sum += c.force_W;
      const Points& x = tissue->positions();
      mesh::interpolate(places, x.leftCols(nodes), &now);
      now = (x.rightCols(database.numFine()) - now).eval();
      largest = std::max(largest, now.colwise().norm().maxCoeff());
      fastest = std::max(fastest, (now - last).colwise().norm().maxCoeff());
      last = now;
      if (visit.time() > 0.3 && visit.time() < 0.39) {
        rough = std::max(rough, std::abs(sum.norm() - before));
        held = sum.norm();
      }
      before = sum.norm();
    }
    EXPECT_GT(largest, 1e-5) << detail;
    EXPECT_LT(fastest, 0.25 * largest + 1e-12) << detail;  // a quarter of the way, or less
    EXPECT_GT(held, 0.0);
    EXPECT_LT(rough, 0.02 * held) << detail;
    EXPECT_LT((tissue->positions() - rest).colwise().norm().maxCoeff(), 2e-5) << detail;
  }
}

TEST(EnrichedTissue, RefusesWhatItCannotTreat) {
  const auto refusal = [](const test::OrganSketch& organ, const ModelSettings& settings) {
    try {
      test::makeOrgans({organ}, settings, nullptr, "enriched");
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  test::OrganSketch organ = blockOf("residual");
  organ.adapt.finest = 0.002;
  EXPECT_TRUE(test::contains(refusal(organ, test::variantSettings()), "leave adapt out"));
  ModelSettings settings = test::variantSettings();
  settings.contact.model = "prescribed";
  EXPECT_TRUE(test::contains(refusal(blockOf("residual"), settings), "contact.model = prescribed"));
}

}  // namespace
}  // namespace palpate::tissue::enriched_test
