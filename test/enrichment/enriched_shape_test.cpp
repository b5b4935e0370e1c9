// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/enrichment/enriched_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "palpate/enrichment/contact_order.h"
#include "palpate/mesh/surface_levels.h"
#include "palpate/organs/organs.h"

namespace palpate::enrichment::enriched_shape_test {
namespace {

// A dent of a given depth and a given width about a point, which moves nothing else.
Points dent(const DeformationDatabase& body, int contact, double depth, double width) {
  Points u = Points::Zero(3, body.numFine());
  const Vec3 middle = body.fine.points.col(contact);
  for (Eigen::Index i = 0; i < u.cols(); ++i) {
    const double r = (body.fine.points.col(i) - middle).norm() / width;
    u(2, i) = -depth * std::exp(-r * r);
  }
  return u;
}

// A slab's surface and the same split once, dented at every third point.
DeformationDatabase dented() {
  DeformationDatabase body;
  body.coarse = mesh::simplify(organs::makeOrgan("slab", 0.015), 200);
  body.fine = mesh::splitTriangles(body.coarse);
  for (int contact = 0; contact < body.numCoarse(); contact += 3) {
    const double depth = 0.002 + 0.004 * std::abs(std::sin(contact));
    body.samples.push_back({contact, Vec3(0, 0, -1), dent(body, contact, depth, 0.02)});
  }
  return body;
}

double rms(const Points& a, const Points& b) {
  return std::sqrt((a - b).squaredNorm() / static_cast<double>(a.cols()));
}

TEST(ContactOrder, BeginsAtTheContactAndGoesAway) {
  const DeformationDatabase body = dented();
  const Vec3 contact = body.fine.points.col(7);
  const std::vector<int> order = contactOrder(body.fine.points, contact);
  EXPECT_EQ(order[0], 7);
  double before = 0.0;
  for (const int i : order) {
    const double away = (body.fine.points.col(i) - contact).norm();
    EXPECT_GE(away, before);
    before = away;
  }
  const Eigen::VectorXd first = ordered(body.fine.points, order, 2);
  EXPECT_EQ(first.head<3>(), contact);
}

TEST(EnrichedShape, IsASampleAtASample) {
  const DeformationDatabase body = dented();
  EnrichedShape shape(body, {}, 1e-9);  // narrower than any two samples are apart
  Points fine;
  for (const Deformation& sample : body.samples) {
    shape.predict(sample.contact, sample.fine, &fine);
    EXPECT_LT(rms(fine, sample.fine), 1e-12);
  }
}

// From the contact equal dents are equal features, wherever they are.
TEST(EnrichedShape, KnowsADentWhereNoneWas) {
  const DeformationDatabase body = dented();
  FeatureSettings numbered;
  numbered.from_contact = false;
  numbered.points = 0;
  EnrichedShape from_contact(body, {}, 1e-3), by_number(body, numbered, 1e-3);
  double ours = 0.0, theirs = 0.0, all = 0.0;
  Points fine;
  for (int contact = 1; contact < body.numCoarse(); contact += 3) {
    const Points truth = dent(body, contact, 0.004, 0.02);
    from_contact.predict(contact, truth, &fine);
    ours += (fine - truth).squaredNorm();
    by_number.predict(contact, truth, &fine);
    theirs += (fine - truth).squaredNorm();
    all += truth.squaredNorm();
  }
  EXPECT_LT(std::sqrt(ours / all), 0.5);
  EXPECT_LT(ours, 0.5 * theirs);
}

// The learned correction of interpolation is zero at rest, doubles with the deformation, and
// improves the interpolation at dents like those of the samples.
TEST(EnrichedShape, LearnsWhatInterpolationLeavesOut) {
  const DeformationDatabase body = dented();
  FeatureSettings settings;
  settings.residual = true;
  EnrichedShape shape(body, settings, 0.05);
  Points fine, twice, plain;
  shape.predict(1, Points::Zero(3, body.numFine()), &fine);
  EXPECT_TRUE(fine.isZero());
  double ours = 0.0, theirs = 0.0;
  for (const Deformation& sample : body.samples) {
    const Points truth = dent(body, sample.contact, 0.003, 0.02);
    shape.predict(sample.contact, truth, &fine);
    shape.interpolate(truth, &plain);
    ours += (fine - truth).squaredNorm();
    theirs += (plain - truth).squaredNorm();
    shape.predict(sample.contact, 2.0 * truth, &twice);
    EXPECT_LT(rms(twice, 2.0 * fine), 1e-15);
  }
  EXPECT_LT(std::sqrt(ours / theirs), 0.5);
}

TEST(EnrichedShape, LeavesInProportionAtRestWhatIsAtRest) {
  const DeformationDatabase body = dented();
  FeatureSettings settings;
  settings.proportional = true;
  EnrichedShape shape(body, settings, 1e-3), published(body, {}, 1e-3);
  Points fine;
  shape.predict(1, Points::Zero(3, body.numFine()), &fine);
  EXPECT_TRUE(fine.isZero());
  published.predict(1, Points::Zero(3, body.numFine()), &fine);
  EXPECT_GT(fine.norm(), 0.001);
  const Points truth = dent(body, body.samples[2].contact, 0.007, 0.02);  // deeper than any
  shape.predict(body.samples[2].contact, truth, &fine);
  EXPECT_LT(rms(fine, truth), 0.3 * rms(truth, Points::Zero(3, truth.cols())));
}

TEST(EnrichedShape, RefusesSamplesOfOtherPoints) {
  DeformationDatabase body = dented();
  body.samples[2].fine.conservativeResize(3, 5);
  EXPECT_THROW(EnrichedShape(body, {}, 1e-3), std::invalid_argument);
  body = dented();
  body.samples[2].contact = static_cast<int>(body.numCoarse());
  EXPECT_THROW(EnrichedShape(body, {}, 1e-3), std::invalid_argument);
  body.samples.clear();
  EXPECT_THROW(EnrichedShape(body, {}, 1e-3), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::enrichment::enriched_shape_test
