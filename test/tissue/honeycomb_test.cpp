// SPDX-License-Identifier: GPL-3.0-or-later
// An organ of cells under tools: what the tool feels, how far it can be pressed, and what it
// refuses.
#include <gtest/gtest.h>

#include <cmath>

#include "model_variants.h"
#include "tissue/models/honeycomb/honeycomb_organ.h"
#include "tissue/models/honeycomb/side_feedback.h"

namespace palpate::tissue::honeycomb_test {
namespace {

using test::kStep;
using test::ModelVariant;
using test::onTool;
using test::Visit;

ModelVariant variantOf(const HoneycombSettings& settings) {
  ModelVariant variant{"honeycomb", "honeycomb", {}, {}};
  variant.honeycomb = settings;
  variant.has_inertia = false;
  return variant;
}

std::unique_ptr<TissueModel> makeBlock(const HoneycombSettings& settings,
                                       const Vec3& gravity = Vec3(0, 0, -9.81)) {
  const ModelVariant variant = variantOf(settings);
  ModelSettings scene = test::variantSettings();
  scene.gravity = gravity;
  return test::makeVariant(variant, test::variantBlock(variant), scene);
}

const HoneycombOrgan& cellsOf(const TissueModel& model) {
  return static_cast<const HoneycombOrgan&>(model);
}

// Under the ball for half a second.
TissueStep hold(TissueModel* tissue, double depth = 0.004) {
  TissueStep last;
  for (Visit visit(depth, 1e9); visit.time() < 0.5;) {
    last = tissue->step({visit.next()}, kStep);
    EXPECT_TRUE(last.ok()) << visit.time() << " " << solver::toString(last.status);
  }
  return last;
}

// What the tool feels is what the pressed sides' fluid and walls press back with (3.20), in the
// tolerance of the solve on each side. The printed signs give something else.
TEST(Honeycomb, ToolFeelsWhatFluidAndWallsPressWith) {
  const auto tissue = makeBlock({});
  const TissueStep step = hold(tissue.get());
  const HoneycombOrgan& organ = cellsOf(*tissue);
  const CellLattice& lattice = organ.balance().lattice();
  double reaction = 0.0, printed = 0.0;
  for (int s = 0; s < lattice.numSides(); ++s) {
    const auto& side = lattice.sides[static_cast<std::size_t>(s)];
    if (side.axis != 2 || side.cells[1] >= 0) continue;
    reaction += sideReaction(organ.balance(), organ.cellState(), s);
    printed += printedSideReaction(organ.balance(), organ.cellState(), s);
  }
  const double felt = onTool(step).z();
  EXPECT_GT(felt, 0.1);
  EXPECT_NEAR(reaction, felt, 6.0 * step.tolerance);  // 36 sides
  std::printf("ball of 8 mm, 4 mm deep: %.4f N felt, (3.20) %.4f N, as printed %.4f N\n", felt,
              reaction, printed);
}

TEST(Honeycomb, BothKindsOfWavesFindOneState) {
  HoneycombSettings settings;
  const auto back = makeBlock(settings);
  const double force = onTool(hold(back.get())).z();
  settings.waves = "outward";
  settings.max_sweeps = 1000;
  const auto outward = makeBlock(settings);
  EXPECT_NEAR(onTool(hold(outward.get())).z(), force, 2e-3 * force);
  settings.mixing = 0;
  settings.max_sweeps = 5000;
  const auto plain = makeBlock(settings);
  EXPECT_NEAR(onTool(hold(plain.get())).z(), force, 2e-3 * force);
}

TEST(Honeycomb, KeepsItsVolumeExactlyOrToFirstOrder) {
  for (const std::string& volume : honeycombVolumeNames()) {
    HoneycombSettings settings;
    settings.volume = volume;
    const auto tissue = makeBlock(settings, Vec3::Zero());
    const TissueStep step = hold(tissue.get());
    const HoneycombOrgan& organ = cellsOf(*tissue);
    const CellLattice& lattice = organ.balance().lattice();
    double sum = 0.0, worst = 0.0;
    for (int c = 0; c < lattice.numCells(); ++c) {
      const double error =
          organ.balance().edges(organ.cellState(), c).prod() / lattice.volume() - 1.0;
      sum += error / lattice.numCells();
      worst = std::max(worst, std::abs(error));
    }
    if (volume == "exact") {
      EXPECT_LT(worst, settings.threshold / lattice.size.maxCoeff());
    }
    std::printf("%s volumes, 4 mm deep: %.3f N, whole %.2e, worst cell %.2e\n", volume.c_str(),
                onTool(step).z(), sum, worst);
  }
}

// A turned and moved organ, its tool and gravity with it.
TEST(Honeycomb, IsTheSameAnywhere) {
  const ModelVariant variant = variantOf({});
  const test::OrganSketch sketch = test::variantBlock(variant);
  const Pose X_WO = poseFromXyzRpy(Vec3(0.1, -0.2, 0.3), Vec3(0.4, -0.7, 1.1));
  ModelDescription description;
  description.organs.push_back(sketch.describe());
  description.settings = test::variantSettings();
  const auto here = makeModel("honeycomb", description);
  description.organs[0].X_WO = X_WO;
  description.settings.gravity = X_WO.linear() * description.settings.gravity;
  const auto there = makeModel("honeycomb", description);
  for (Visit visit; visit.time() < 0.6;) {
    contact::Obstacle ball = visit.next();
    const Vec3 force = onTool(here->step({ball}, kStep));
    ball.X_WG_begin = X_WO * ball.X_WG_begin;
    ball.X_WG_end = X_WO * ball.X_WG_end;
    const TissueStep& step = there->step({ball}, kStep);
    ASSERT_TRUE(step.ok());
    EXPECT_LT((onTool(step) - X_WO.linear() * force).norm(), 10.0 * step.tolerance);
  }
}

TEST(Honeycomb, CutOffIsSeenAsImbalance) {
  HoneycombSettings settings;
  settings.cut_off = 2e-5;
  const auto tissue = makeBlock(settings), whole = makeBlock({});
  double worst = 0.0, error = 0.0;
  std::int64_t cells = 0, all = 0;
  for (Visit a, b; a.time() < 0.4;) {
    const TissueStep& step = tissue->step({a.next()}, kStep);
    const TissueStep& plain = whole->step({b.next()}, kStep);
    ASSERT_TRUE(step.ok());
    cells += step.linear_iterations;
    all += plain.linear_iterations;
    worst = std::max(worst, (step.support_force + step.gravity_force - onTool(step)).norm());
    error = std::max(error, (onTool(step) - onTool(plain)).norm());
  }
  EXPECT_LE(cells, all);
  std::printf("cut off 0.02 mm: %.0f %% of the cells, imbalance %.1e N, force %.1e N off\n",
              100.0 * static_cast<double>(cells) / static_cast<double>(all), worst, error);
}

// Into a block of 30 mm, and out again. How far it converges is what theory.md says; whatever
// happens it is told, nothing is NaN, and in the end all is as before.
TEST(Honeycomb, SaysWhenItIsPressedTooFar) {
  for (const std::string& volume : honeycombVolumeNames()) {
    HoneycombSettings settings;
    settings.volume = volume;
    const auto tissue = makeBlock(settings);
    const Points rest = tissue->positions();
    double first = 0.0, thinnest = 1.0;
    int failed = 0, cycles = 0;
    std::string status;
    for (Visit visit(0.026, 0.6); visit.time() < 1.6;) {
      const double t = visit.time();
      const TissueStep& step = tissue->step({visit.next()}, kStep);
      ASSERT_TRUE(tissue->positions().allFinite() && tissue->velocities().allFinite());
      ++cycles;
      if (step.ok()) {
        thinnest = std::min(thinnest, step.min_jacobian);
        continue;
      }
      if (failed++ == 0)
        first = std::min(0.05 * t - 0.002, 0.026), status = solver::toString(step.status);
      EXPECT_FALSE(onTool(step).hasNaN());
    }
    EXPECT_TRUE(tissue->step({}, kStep).ok());
    for (int k = 0; k < 10; ++k) tissue->step({}, kStep);
    EXPECT_LT((tissue->positions() - rest).cwiseAbs().maxCoeff(), 1e-5);
    std::printf("%s volumes: %d of %d cycles failed, first at %.1f mm (%s); least ratio %.2f\n",
                volume.c_str(), failed, cycles, 1e3 * first, status.c_str(), thinnest);
  }
}

// How many bytes of two states are alike, from the first on.
std::size_t alike(const State& a, const State& b) {
  std::size_t k = 0;
  while (k < std::min(a.bytes.size(), b.bytes.size()) && a.bytes[k] == b.bytes[k]) ++k;
  return k;
}

// A ball that leaps through a block within one cycle turns cells inside out on its way, where they
// would stay: the cycle is given up then, not solved at each stage of the way, and rolled back,
// with what cells that are cut off remember.
TEST(Honeycomb, GivesUpALeapThatTurnsCellsInsideOut) {
  HoneycombSettings settings;
  settings.cut_off = 2e-5;
  const auto tissue = makeBlock(settings);
  Visit visit(0.004, 1e9);
  const contact::Obstacle first = visit.next();
  tissue->step({first}, kStep);
  const State before = tissue->state();
  contact::Obstacle through = first;
  through.X_WG_begin = first.X_WG_end;
  through.X_WG_end.translation().z() -= 0.1;
  const TissueStep& step = tissue->step({through}, kStep);
  EXPECT_EQ(step.recovery, static_cast<int>(Recovery::kRolledBack));
  EXPECT_LE(step.sweep_stages, 12);  // 31 where it goes on
  // Sides, pressures, turns, velocities, and how far the sides of cells have moved unseen.
  const HoneycombOrgan& organ = cellsOf(*tissue);
  const Eigen::Index cells = organ.cellState().pressures.size();
  const Eigen::Index numbers =
      organ.cellState().sides.size() + 5 * cells + tissue->velocities().size();
  EXPECT_GE(alike(tissue->state(), before), sizeof(double) * static_cast<std::size_t>(numbers));
}

// Cells whose centres are in the organ: a block of which a quarter is missing.
TEST(Honeycomb, FillsWhatIsNoBox) {
  const ModelVariant variant = variantOf({});
  test::OrganSketch organ = test::variantBlock(variant);
  std::vector<int> kept;
  for (int t = 0; t < organ.mesh.numTets(); ++t) {
    Vec3 middle = Vec3::Zero();
    for (const int i : organ.mesh.tets.col(t)) middle += 0.25 * organ.mesh.points.col(i);
    if (middle.x() < 0.03 || middle.y() < 0.03 || middle.z() < 0.01) kept.push_back(t);
  }
  organ.mesh.tets = organ.mesh.tets(Eigen::all, kept).eval();
  const auto tissue = test::makeVariant(variant, organ, test::variantSettings());
  EXPECT_EQ(tissue->cells(0).numCells(), 6 * 6 * 3 - 3 * 3 * 2);
  EXPECT_EQ(tissue->cells(0).cells.rows(), 8);
  // Its surface is closed, and around its volume.
  double volume = 0.0;
  Vec3 area = Vec3::Zero();
  const Points X = tissue->cells(0).points;
  const SurfaceState shape = tissue->surfaceState(0);
  for (const auto& t : shape.triangles.colwise()) {
    volume += X.col(t[0]).dot(X.col(t[1]).cross(X.col(t[2]))) / 6.0;
    area += (X.col(t[1]) - X.col(t[0])).cross(X.col(t[2]) - X.col(t[0]));
  }
  EXPECT_NEAR(volume, 90e-6, 1e-15);
  EXPECT_LT(area.norm(), 1e-15);
  const TissueStep step = hold(tissue.get(), 0.003);
  EXPECT_GT(onTool(step).z(), 0.05);
  EXPECT_LT((step.support_force + step.gravity_force - onTool(step)).norm(), 14.0 * step.tolerance);
}

TEST(Honeycomb, GoesOnFromWhereItIsPlaced) {
  const auto tissue = makeBlock({}), other = makeBlock({});
  hold(tissue.get());
  other->setPositions(0, tissue->positions(), tissue->velocities());
  EXPECT_LT((other->positions() - tissue->positions()).cwiseAbs().maxCoeff(), 1e-4);
  for (int k = 0; k < 5; ++k) EXPECT_TRUE(other->step({}, kStep).ok());
  other->step({}, kStep);
  const auto rest = makeBlock({});
  EXPECT_LT((other->positions() - rest->positions()).cwiseAbs().maxCoeff(), 1e-5);
}

std::string refusal(const HoneycombSettings& settings,
                    const std::function<void(test::OrganSketch*)>& change) {
  const ModelVariant variant = variantOf(settings);
  test::OrganSketch organ = test::variantBlock(variant);
  change(&organ);
  try {
    test::makeVariant(variant, organ, test::variantSettings());
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Honeycomb, RefusesWhatCellsCannotBe) {
  const auto says = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(says(refusal({}, [](test::OrganSketch* o) { o->adapt.finest = 0.002; }), "adapt"));
  EXPECT_TRUE(says(refusal({},
                           [](test::OrganSketch* o) {
                             o->solid.prony = {{0.3, 0.1}};
                           }),
                   "viscoelastic"));
  EXPECT_TRUE(says(refusal({}, [](test::OrganSketch* o) { o->held = {}; }), "supports"));
  ModelSettings folds = test::variantSettings();
  folds.touching.self = true;
  EXPECT_THROW(test::makeVariant(variantOf({}), test::variantBlock(variantOf({})), folds),
               std::invalid_argument);
  HoneycombSettings fine;
  fine.cell_size = 5e-4;
  EXPECT_TRUE(says(refusal(fine, [](test::OrganSketch*) {}), "honeycomb.cell_size"));
}

// A solve that has not enough waves says so, goes on from there, and comes to the same state.
TEST(Honeycomb, SaysWhenItHasTooFewWaves) {
  HoneycombSettings settings;
  settings.max_sweeps = 3;
  const auto tissue = makeBlock(settings), whole = makeBlock({});
  int limited = 0;
  TissueStep last, plain;
  for (Visit a(0.004, 1e9), b(0.004, 1e9); a.time() < 0.6;) {
    last = tissue->step({a.next()}, kStep);
    plain = whole->step({b.next()}, kStep);
    limited += last.status == solver::SolveStatus::kIterationLimit;
    ASSERT_TRUE(tissue->positions().allFinite());
  }
  EXPECT_GT(limited, 3);
  EXPECT_TRUE(last.ok());
  EXPECT_NEAR(onTool(last).z(), onTool(plain).z(), 2e-3 * onTool(plain).z());
}

}  // namespace
}  // namespace palpate::tissue::honeycomb_test
