// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets of springs as organs: both sides, bending by preload, a rolled start and its layers, and
// what is refused.
#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>
#include <functional>

#include "model_variants.h"
#include "palpate/contact/layer_contact.h"
#include "palpate/springs/spring_grids.h"
#include "palpate/springs/springs_file.h"
#include "support/temp_folder.h"
#include "tissue/models/cloth/rolled_shape.h"
#include "tissue/models/cloth/sheet_elasticity.h"
#include "tissue/models/cloth/sheet_network.h"

namespace palpate::tissue::cloth_test {
namespace {

using test::kStep;
using test::onTool;

constexpr double kPi = 3.14159265358979323846;

std::unique_ptr<TissueModel> make(const test::OrganSketch& sheet, const ModelSettings& settings) {
  return test::makeOrgans({sheet}, settings, nullptr, "cloth");
}

ModelSettings weightless() {
  ModelSettings settings = test::variantSettings();
  settings.gravity.setZero();
  settings.max_newton_iterations = 60;
  return settings;
}

SheetNetwork networkOf(const test::OrganSketch& sheet) {
  std::vector<std::string> notes;
  return sheetNetwork(sheet.describe(), sheet.solid, &notes);
}

// Force on a ball of 8 mm that has pressed the middle by `depth` from above or below.
Vec3 pressed(const test::OrganSketch& sheet, double side, double depth) {
  const auto tissue = make(sheet, weightless());
  const instrument::Geometry ball = instrument::Sphere{0.008};
  Vec3 force = Vec3::Zero();
  double from = -0.001;
  for (int k = 0; k < 100; ++k) {
    const double to = std::min(-0.001 + 2e-4 * k, depth);
    const auto at = [&](double d) {
      return poseFromXyzRpy(Vec3(0.03, 0.03, 0.03 + side * (0.008 + 0.0005 - d)), Vec3::Zero());
    };
    const TissueStep& step = tissue->step({{&ball, 0, at(from), at(to)}}, kStep);
    EXPECT_TRUE(step.ok());
    EXPECT_EQ(step.tools_inside, 0);
    from = to;
    force = onTool(step);
  }
  return force;
}

TEST(Cloth, IsTouchedFromEitherSideAndAsThickAsItIs) {
  test::OrganSketch sheet = test::sheetSketch();
  EXPECT_EQ(pressed(sheet, 1.0, -1e-5).norm(), 0.0);  // half of the thickness above the middle
  const Vec3 above = pressed(sheet, 1.0, 0.004), below = pressed(sheet, -1.0, 0.004);
  EXPECT_GT(above.z(), 0.05);
  EXPECT_NEAR(below.z(), -above.z(), 1e-3 * above.z());
  EXPECT_NEAR(below.x(), above.x(), 1e-3 * above.z());
}

// A strip that is built in at one end and pulled at the other one bends as a plate does; to first
// order as one with D, of Poisson's ratio 1/3 instead of nu, and by a discrete factor.
TEST(Cloth, BendsByItsPreloadAlone) {
  test::OrganSketch sheet = test::sheetSketch(false);
  sheet.cloth.width = 0.024;
  sheet.cloth.length = 0.1;
  sheet.cloth.spacing = 0.004;
  const auto tip = [&](double gravity) {
    sheet.held = [](const Vec3& X) { return X.y() < 0.0036; };
    ModelSettings settings = weightless();
    settings.gravity.z() = -gravity;
    const auto tissue = make(sheet, settings);
    return 0.03 - tissue->positions().row(2).tail(1)(0);
  };
  // A cantilever under its weight: q L^4/(8 D') with D' = E h^3/12 of a narrow strip [Euler,
  // Bernoulli], up to the plate's D, which is 10 % stiffer. Springs alone: a tenth of gravity.
  const double gravity = 0.1, L = 0.1 - 0.00346, q = 1060.0 * 0.001 * gravity;
  const double narrow = q * std::pow(L, 4) / (8.0 * 1e6 * 1e-9 / 12.0);
  const double sag = tip(gravity);
  EXPECT_LT(sag, 1.15 * narrow);
  EXPECT_GT(sag, 0.8 * narrow);
}

TEST(Cloth, CostsNothingToBendWithoutPreload) {
  test::OrganSketch sheet = test::sheetSketch(false);
  const auto energyOf = [&](bool preload) {
    sheet.cloth.preload = preload;
    const SheetNetwork net = networkOf(sheet);
    SheetElasticity elasticity(net.network, net.triangles, sheet.cloth.thickness);
    Points x = net.network.points;
    // To a cylinder of radius R, at constant distances along it but for chords: U^2/(24 R^2).
    constexpr double kRadius = 1.0;
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      const double angle = x(1, i) / kRadius;
      x(1, i) = kRadius * std::sin(angle);
      x(2, i) = kRadius * (1.0 - std::cos(angle));
    }
    return elasticity.energy(x) - elasticity.energy(net.network.points);
  };
  const double D = 1e6 * 1e-9 / (12.0 * (1.0 - 0.09)), area = 0.063 * 0.0624;
  const double plate = 0.5 * D * area;
  EXPECT_GT(energyOf(true), 0.75 * plate);  // free edges lack springs
  EXPECT_LT(energyOf(true), 1.05 * plate);
  EXPECT_LT(energyOf(false), 1e-4 * plate);
}

TEST(Cloth, TakesTheSpringsOfAFile) {
  test::OrganSketch sheet = test::sheetSketch();
  const double regular = pressed(sheet, 1.0, 0.003).z();
  const test::TempFolder folder;
  sheet.springs.constants = "file";
  sheet.springs.file = folder.path("springs.csv");
  springs::SpringNetwork network = networkOf(test::sheetSketch()).network;
  springs::writeSprings(sheet.springs.file, network);
  EXPECT_NEAR(pressed(sheet, 1.0, 0.003).z(), regular, 1e-12);
  sheet.springs.constants = "fitted";
  EXPECT_NEAR(pressed(sheet, 1.0, 0.003).z(), regular, 0.3 * regular);
  network.points(0, 3) += 0.001;
  springs::writeSprings(sheet.springs.file, network);
  sheet.springs.constants = "file";
  EXPECT_THROW(networkOf(sheet), std::invalid_argument);
}

// A surface is taken as it is, open, and fitted.
TEST(Cloth, TakesAnOpenSurface) {
  const SheetNetwork made = networkOf(test::sheetSketch());
  OrganDescription organ = test::sheetSketch().describe();
  organ.cloth.width = organ.cloth.length = organ.cloth.spacing = 0.0;
  organ.sheet = [&] { return mesh::SurfaceMesh{made.network.points, made.triangles}; };
  std::vector<std::string> notes;
  const test::OrganSketch sheet = test::sheetSketch();
  const SheetNetwork read = sheetNetwork(organ, sheet.solid, &notes);
  EXPECT_EQ(notes.size(), 1U);
  EXPECT_EQ(read.triangles, made.triangles);
  EXPECT_NEAR(read.network.masses.sum(), made.network.masses.sum(), 1e-15);
}

// r = R (1 - c beta), neighbours as far apart along it as at rest but for their chords.
TEST(RolledShape, IsTheSpiral) {
  const RolledSettings rolled{0.012, 0.03, 1e-4, 1e-3};
  Points X = Points::Zero(3, 400);
  for (Eigen::Index i = 0; i < X.cols(); ++i) X.col(i) << 0.5, 0.1 + 5e-4 * i, 0.2;
  const Points x = rolledUp(X, 5e-4, rolled);
  EXPECT_LT((x.col(0) - X.col(0)).norm(), 1e-15);
  double turned = 0.0, last = 0.0;
  for (Eigen::Index i = 1; i < x.cols(); ++i) {
    const double dy = x(1, i) - 0.1, dz = 0.2 + rolled.radius - x(2, i);
    double angle = std::atan2(dy, dz);
    while (angle + turned < last) turned += 2.0 * kPi;
    last = angle + turned;
    EXPECT_NEAR(std::hypot(dy, dz), rolled.radius * (1.0 - rolled.loss * last), 1e-12);
    const double way = (x.col(i) - x.col(i - 1)).norm();
    // A chord; and the innermost turns are bent a little more than 1/r.
    const double r = rolled.radius * (1.0 - rolled.loss * last);
    EXPECT_LT(way, 5e-4 * (1.0 + 1e-9));
    EXPECT_GT(way, 5e-4 * (1.0 - 1.1 * 5e-4 * 5e-4 / (24.0 * r * r)));
  }
  EXPECT_GT(last, 4.0 * kPi);
}

test::OrganSketch rolledSheet(bool preload = true) {
  test::OrganSketch sheet = test::sheetSketch();
  sheet.cloth.preload = preload;
  sheet.cloth.thickness = 5e-4;
  sheet.cloth.width = 0.03;
  sheet.cloth.length = 0.1;
  sheet.cloth.spacing = 0.003;
  sheet.cloth.rolled = RolledSettings{0.012, 0.035, 3e-4, 1.5e-3};
  sheet.damping = {3.0, 0.0};
  sheet.held = [](const Vec3& X) { return X.y() < 0.0027; };
  return sheet;
}

contact::LayerContact layersOf(const test::OrganSketch& sheet) {
  const SheetNetwork net = networkOf(sheet);
  return contact::LayerContact(net.network.points, net.triangles,
                               Eigen::VectorXd::Ones(net.network.points.cols()), {1e-4, 1e-2, 1.0});
}

// How far from the plane that is nearest to all of them points are, at most [m].
double outOfPlane(const Points& x) {
  const Points from_middle = x.colwise() - x.rowwise().mean();
  const Eigen::JacobiSVD<Mat3> svd(Mat3(from_middle * from_middle.transpose()),
                                   Eigen::ComputeFullU);
  return (svd.matrixU().col(2).transpose() * from_middle).cwiseAbs().maxCoeff();
}

// Free of all; its slowest mode is that of a free strip, 10/s, which drag of 3/s damps within
// seconds.
TEST(RolledCloth, UnrollsByItsPreloadAndKeepsItsLayersApart) {
  test::OrganSketch sheet = rolledSheet();
  sheet.held = [](const Vec3&) { return false; };
  const contact::LayerContact gaps = layersOf(sheet);
  const auto tissue = make(sheet, weightless());
  EXPECT_GT(outOfPlane(tissue->positions()), 0.01);
  double least = 1.0;
  for (double t = 0.0; t < 6.0; t += 0.005) {
    const TissueStep& step = tissue->step({}, 0.005);
    ASSERT_TRUE(step.ok()) << t << " " << solver::toString(step.status);
    least = std::min(least, gaps.leastGap(tissue->positions()));
  }
  EXPECT_GT(least, sheet.cloth.rolled->gap_least);
  EXPECT_LT(outOfPlane(tissue->positions()), 1e-4);
}

// Nobody holds it: inner forces only, so that its momentum stays zero, and its moment.
TEST(RolledCloth, KeepsItsMomentum) {
  for (const char* scheme : {"implicit", "symplectic_euler"}) {
    test::OrganSketch sheet = rolledSheet();
    sheet.damping = {0.0, 0.0};
    sheet.held = [](const Vec3&) { return false; };
    sheet.springs.scheme = scheme;
    ModelSettings settings = weightless();
    settings.tolerance = 1e-8;
    settings.position_tolerance = 0.0;
    const Eigen::VectorXd masses = networkOf(sheet).network.masses;
    const auto tissue = make(sheet, settings);
    for (int k = 0; k < 30; ++k) {
      const TissueStep& step = tissue->step({}, 0.002);
      ASSERT_TRUE(step.ok());
      const Vec3 momentum = tissue->velocities() * masses;
      const double all = tissue->velocities().cwiseAbs().colwise().sum().dot(masses);
      const bool exact = std::string(scheme) != "implicit";
      EXPECT_LT(momentum.norm(), (exact ? 1e-12 : 1e-5) * all) << scheme << " " << k;
    }
    EXPECT_GT(tissue->velocities().norm(), 0.1);
  }
}

TEST(RolledCloth, GoesOnFromAStateAndAfterAReset) {
  for (const char* scheme : {"implicit", "symplectic_euler"}) {
    test::OrganSketch sheet = rolledSheet();
    sheet.springs.scheme = scheme;
    const auto whole = make(sheet, weightless()), other = make(sheet, weightless());
    const Points begin = whole->positions();
    for (int k = 0; k < 10; ++k) whole->step({}, 0.005);
    const State saved = whole->state();
    other->restore(saved);
    EXPECT_TRUE(other->state() == saved);
    for (int k = 0; k < 5; ++k) {
      whole->step({}, 0.005);
      other->step({}, 0.005);
      ASSERT_TRUE(whole->state() == other->state()) << scheme << " " << k;
    }
    other->reset();
    EXPECT_EQ(other->positions(), begin);
  }
}

// By every method that knows layers, within what Newton's tolerance leaves.
TEST(RolledCloth, UnrollsAlikeByEveryMethodThatKnowsLayers) {
  Points reference;
  for (const char* method : {"implicit_pcg", "implicit_direct", "implicit_async", "lbfgs"}) {
    ModelSettings settings = weightless();
    settings.method = method;
    settings.max_newton_iterations = 1000;
    const auto tissue = make(rolledSheet(), settings);
    for (int k = 0; k < 10; ++k) ASSERT_TRUE(tissue->step({}, 0.005).ok()) << method << " " << k;
    if (reference.cols() == 0) reference = tissue->positions();
    EXPECT_LT((tissue->positions() - reference).cwiseAbs().maxCoeff(), 2e-4) << method;
  }
  for (const char* method : {"tled", "linear_precomputed", "auto"}) {
    ModelSettings settings = weightless();
    settings.method = method;
    EXPECT_THROW(make(rolledSheet(), settings), std::invalid_argument) << method;
  }
}

std::string refusal(const std::function<void(test::OrganSketch*)>& change) {
  test::OrganSketch sheet = rolledSheet();
  change(&sheet);
  try {
    make(sheet, weightless());
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Cloth, RefusesWhatASheetCannotBe) {
  const auto says = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos ? "" : "'" + text + "' for " + part;
  };
  using Sheet = test::OrganSketch;
  EXPECT_EQ(refusal([](Sheet*) {}), "");
  EXPECT_EQ(says(refusal([](Sheet* s) { s->cloth.thickness = 0.0; }), "cloth.thickness = 0"), "");
  EXPECT_EQ(
      says(refusal([](Sheet* s) { s->cloth.width = s->cloth.length = s->cloth.spacing = 0.0; }),
           "takes no tetrahedra"),
      "");
  EXPECT_EQ(says(refusal([](Sheet* s) { s->cloth.spacing = 0.02; }), "cloth.spacing = 0.02"), "");
  EXPECT_EQ(says(refusal([](Sheet* s) { s->cloth.rolled->gap_least = 0.002; }),
                 "cloth.rolled.gap_least = 0.002"),
            "");
  EXPECT_EQ(says(refusal([](Sheet* s) { s->cloth.rolled->radius = 0.006; }),
                 "cloth.rolled.radius = 0.006"),
            "");
  EXPECT_EQ(
      says(refusal([](Sheet* s) { s->cloth.rolled->loss = 0.003; }), "cloth.rolled.loss = 0.003"),
      "");
  EXPECT_EQ(says(refusal([](Sheet* s) { s->cloth.rolled->loss = 0.0; }), "cloth.rolled.radius"),
            "");
  EXPECT_EQ(says(refusal([](Sheet* s) { s->adapt.finest = 0.002; }), "adapt"), "");
  EXPECT_EQ(says(refusal([](Sheet* s) { s->solid.prony = {{0.3, 0.1}}; }), "viscoelastic"), "");
  EXPECT_EQ(says(refusal([](Sheet* s) {
                   s->springs.scheme = "symplectic_euler";
                   s->springs.step = 0.5;
                 }),
                 "springs.step = 0.5"),
            "");
}

}  // namespace
}  // namespace palpate::tissue::cloth_test
