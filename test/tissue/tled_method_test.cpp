// SPDX-License-Identifier: GPL-3.0-or-later
// Explicit total Lagrangian dynamics (method tled).
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "liver_slab.h"
#include "support/contains.h"
#include "support/random.h"

namespace palpate::tissue::tled_method_test {
namespace {

using test::LiverPress;
using test::LiverSlab;
constexpr double kStep = 0.01;

double energy(const TissueStep& step) { return step.kinetic_energy + step.elastic_energy; }

// A bar of square section along z, held at z = 0, that gets velocities at rest.
struct Bar {
  static constexpr double kLength = 0.2;
  LiverSlab slab{"tled"};

  explicit Bar(double poisson_ratio) {
    slab.mesh = mesh::boxMesh(Vec3(0.02, 0.02, kLength), Eigen::Vector3i(2, 2, 20));
    slab.free = fem::FreeMask::Ones(3, slab.mesh.numPoints());
    for (Eigen::Index i = 0; i < slab.mesh.numPoints(); ++i) {
      if (slab.mesh.points(2, i) == 0.0) slab.free.col(i).setZero();
    }
    slab.settings.element = "tet4";
    slab.law = LiverSlab::liver("stable_neo_hookean", poisson_ratio);
  }
  std::unique_ptr<TissueModel> push(const std::function<Vec3(const Vec3&)>& velocity) const {
    auto tissue = slab.make();
    Points v(3, slab.mesh.numPoints());
    for (Eigen::Index i = 0; i < v.cols(); ++i) v.col(i) = velocity(slab.mesh.points.col(i));
    tissue->setPositions(0, slab.mesh.points, v);
    return tissue;
  }
};

TEST(Tled, KeepsTheEnergyOfAFreeVibration) {
  const Bar bar(0.45);
  const auto tissue = bar.push([](const Vec3& X) { return Vec3(2.0 * X.z(), 0.0, -X.z()); });
  const double begin = energy(tissue->step({}, 1e-4));
  double largest_elastic = 0.0;
  for (int k = 0; k < 300; ++k) {
    const TissueStep& step = tissue->step({}, kStep);
    ASSERT_TRUE(step.ok());
    EXPECT_NEAR(energy(step), begin, 0.01 * begin);
    largest_elastic = std::max(largest_elastic, step.elastic_energy);
  }
  EXPECT_GT(largest_elastic, 0.5 * begin);  // it did swing
}

// Fibres that are slack in each second step of a mode and taut in the other make it grow, where
// steps are longer than sqrt(2) / w, though each of both is stable up to 2 / w.
TEST(Tled, KeepsTheEnergyOfFibresThatGoSlack) {
  const Bar bar(0.45);
  const material::Constants constants{{"a", {2e3}},   {"b", {1.0}},   {"af", {2e4}},
                                      {"bf", {1.5}},  {"as", {1e4}},  {"bs", {1.2}},
                                      {"afs", {7e2}}, {"bfs", {1.1}}, {"kappa", {1.5e3}}};
  fem::Composition composition =
      fem::Composition::uniform(material::makeMaterial("holzapfel_ogden", constants), 1060.0);
  composition.frames.assign(static_cast<std::size_t>(bar.slab.mesh.numTets()),
                            poseFromXyzRpy(Vec3::Zero(), Vec3(0.3, 0.5, 0.1)).linear());
  const auto tissue = makeFemTissue(bar.slab.mesh, composition, bar.slab.free, bar.slab.settings);
  const Points& X = bar.slab.mesh.points;
  tissue->setPositions(0, X, test::Random(3).points(X.cols(), 0.02).cwiseProduct(bar.slab.free));
  const double begin = energy(tissue->step({}, 1e-4));
  double largest = 0.0;
  for (int k = 0; k < 300; ++k) {
    const TissueStep& step = tissue->step({}, kStep);
    ASSERT_TRUE(step.ok());
    largest = std::max(largest, energy(step));
  }
  // Of central differences [Belytschko, Liu, Moran 2000, sec. 6.2]: 1 / (1 - (w h / 2)^2).
  EXPECT_LT(largest, 2.0 * begin);
}

// c/(4 L) with c = sqrt(E/rho), of small axial vibrations [Rayleigh 1877].
TEST(Tled, FirstFrequencyOfABarIsTheClosedForm) {
  Bar bar(0.0);
  bar.slab.settings.position_tolerance = 1e-9;  // it swings by hundredths of a millimetre only
  const auto tissue = bar.push(
      [](const Vec3& X) { return Vec3(0.0, 0.0, 1e-3 * std::sin(0.5 * M_PI * X.z() / 0.2)); });
  const Eigen::Index tip = bar.slab.mesh.numPoints() - 1;
  ASSERT_DOUBLE_EQ(bar.slab.mesh.points(2, tip), Bar::kLength);
  std::vector<double> crossings;  // downwards
  double last = 0.0;
  constexpr double kShort = 0.002;
  for (int k = 1; k < 1000; ++k) {
    tissue->step({}, kShort);
    const double u = tissue->positions()(2, tip) - Bar::kLength;
    if (last > 0.0 && u <= 0.0) crossings.push_back(kShort * (k - u / (u - last)));
    last = u;
  }
  ASSERT_GE(crossings.size(), 4u);
  const double period = (crossings.back() - crossings.front()) / (crossings.size() - 1.0);
  const double wave = std::sqrt(6.0e3 / bar.slab.density);
  EXPECT_NEAR(period, 4.0 * Bar::kLength / wave, 0.005 * period);
}

struct Pressed {
  double force;
  Points x;
};
Pressed pressAndHold(const LiverSlab& slab, double seconds, double step, double depth = 0.006) {
  const auto tissue = slab.make();
  double force = 0.0;
  for (LiverPress press(depth, 0.05, step); press.time() < seconds;) {
    force = test::onTool(tissue->step({press.next()}, step)).z();
  }
  return {force, tissue->positions()};
}

TEST(Tled, AgreesWithImplicitMethodsOnAPressedSlab) {
  for (const double poisson_ratio : {0.45, 0.49}) {
    LiverSlab explicit_slab("tled"), implicit_slab("implicit_pcg");
    for (LiverSlab* slab : {&explicit_slab, &implicit_slab}) {
      slab->law = LiverSlab::liver("stable_neo_hookean", poisson_ratio);
      slab->settings.mass_damping = 30.0;
      slab->settings.tolerance = 1e-6;
    }
    implicit_slab.settings.integrator = "bdf2";
    const Pressed a = pressAndHold(explicit_slab, 2.0, kStep);
    const Pressed b = pressAndHold(implicit_slab, 2.0, kStep);
    EXPECT_GT(b.force, 0.5);
    EXPECT_NEAR(a.force, b.force, 1e-3 * b.force);
    EXPECT_LT((a.x - b.x).norm(), 1e-3 * (b.x - implicit_slab.mesh.points).norm());
  }
}

TEST(Tled, AgreesWithSmallImplicitStepsOnTheWay) {
  LiverSlab explicit_slab("tled"), implicit_slab("implicit_pcg");
  implicit_slab.settings.integrator = "bdf2";
  implicit_slab.settings.tolerance = 1e-6;
  for (LiverSlab* slab : {&explicit_slab, &implicit_slab}) {
    slab->settings.mass_damping = 5.0;
    slab->settings.contact.model = "penalty";  // a multiplier learns from step to step
  }
  const auto a = explicit_slab.make(), b = implicit_slab.make();
  LiverPress press(0.006, 0.05, kStep), slow(0.006, 0.05, 5e-4);
  double square = 0.0, peak = 0.0;
  for (int k = 0; k < 30; ++k) {
    const double force = test::onTool(a->step({press.next()}, kStep)).z();
    double reference = 0.0;
    for (int part = 0; part < 20; ++part) {
      reference = test::onTool(b->step({slow.next()}, 5e-4)).z();
    }
    square += std::pow(force - reference, 2);
    peak = std::max(peak, reference);
  }
  EXPECT_LT(std::sqrt(square / 30.0), 0.015 * peak);
}

TEST(Tled, BalancesForcesInEveryCycle) {
  LiverSlab slab("tled");
  slab.settings.gravity = Vec3(0.0, 0.0, -9.81);
  slab.settings.mass_damping = 5.0;
  const auto tissue = slab.make();
  double peak = 0.0;
  for (LiverPress press(0.01, 0.1); press.time() < 0.4;) {
    const TissueStep& step = tissue->step({press.next()}, kStep);
    ASSERT_TRUE(step.ok());
    EXPECT_LE(step.residual, step.tolerance);
    peak = std::max(peak, test::onTool(step).norm());
    EXPECT_LT(test::imbalance(step).norm(), 1e-9);
  }
  EXPECT_GT(peak, 0.5);
}

// 15 mm deep at 1 m/s: the wave speed is 4.4 m/s.
class TledFast : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Elements, TledFast, ::testing::ValuesIn(fem::elementNames()),
                         [](const auto& kind) { return kind.param; });
TEST_P(TledFast, AToolAtOneMetreASecondDoesNotBlowItUp) {
  for (const double poisson_ratio : {0.45, 0.49}) {
    LiverSlab slab("tled", Eigen::Vector3i(6, 6, 3), GetParam());
    slab.law = LiverSlab::liver("stable_neo_hookean", poisson_ratio);
    slab.settings.mass_damping = 20.0;
    const auto tissue = slab.make();
    double peak = 0.0, last = 0.0;
    for (LiverPress press(0.015, 1.0); press.time() < 0.5;) {
      const TissueStep& step = tissue->step({press.next()}, kStep);
      EXPECT_TRUE(step.ok()) << solver::toString(step.status) << " at " << press.time();
      ASSERT_TRUE(std::isfinite(energy(step)));
      last = test::onTool(step).z();
      peak = std::max(peak, energy(step));
    }
    EXPECT_LT(peak, 0.2);  // 20 N over 10 mm
    EXPECT_GT(last, 1.0);
    EXPECT_LT(last, 20.0);
  }
}

TEST(Tled, SameInputsSameBitsWhateverTheThreads) {
  ThreadPool pool(3);
  const LiverSlab slab("tled");
  const auto one = slab.make(), two = slab.make(&pool);
  Points end;
  for (int run = 0; run < 2; ++run) {
    for (LiverPress a(0.01, 0.2), b(0.01, 0.2); a.time() < 0.2;) {
      const Vec3 force = test::onTool(one->step({a.next()}, kStep));
      ASSERT_EQ(force, test::onTool(two->step({b.next()}, kStep)));
      ASSERT_EQ(one->positions(), two->positions());
    }
    if (run == 0) end = one->positions();
    EXPECT_EQ(one->positions(), end);
    one->reset();
    two->reset();
  }
}

TEST(Tled, ComesToRestSleepsAndWakes) {
  LiverSlab slab("tled", Eigen::Vector3i(6, 6, 3));
  slab.settings.gravity = Vec3(0.0, 0.0, -9.81);
  slab.settings.mass_damping = 60.0;
  const auto tissue = slab.make();
  const Points begin = tissue->positions();
  for (int k = 0; k < 3; ++k) tissue->step({}, kStep);
  EXPECT_TRUE(tissue->step({}, kStep).slept);
  for (LiverPress press(0.008, 0.1); press.time() < 0.3;) {
    EXPECT_FALSE(tissue->step({press.next()}, kStep).slept);
  }
  EXPECT_GT((tissue->positions() - begin).cwiseAbs().maxCoeff(), 1e-3);
  bool slept = false;
  for (int k = 0; k < 1000 && !slept; ++k) slept = tissue->step({}, kStep).slept;
  EXPECT_TRUE(slept);
  EXPECT_LT((tissue->positions() - begin).cwiseAbs().maxCoeff(), 1e-4 * 0.1);
}

TEST(Tled, TakesCyclesOfAnyLength) {
  LiverSlab even("tled"), odd("tled");
  even.settings.mass_damping = odd.settings.mass_damping = 30.0;
  const Pressed a = pressAndHold(even, 1.0, kStep);
  const auto tissue = odd.make();
  double force = 0.0, t = 0.0;
  const instrument::Geometry ball = instrument::Sphere{0.01};
  const auto at = [](double time) {
    const double z = std::max(0.052 - 0.05 * time, 0.044);
    return poseFromXyzRpy(Vec3(0.05, 0.05, z), Vec3::Zero());
  };
  for (int k = 0; t < 1.0; ++k) {
    const double dt = std::vector<double>{0.01, 0.0007, 0.033, 1e-5}[k % 4];
    const TissueStep& step = tissue->step({{&ball, 0, at(t), at(t + dt)}}, dt);
    ASSERT_TRUE(step.ok());
    EXPECT_LT(test::imbalance(step).norm(), 1e-9);
    force = test::onTool(step).z();
    t += dt;
  }
  EXPECT_NEAR(force, a.force, 2e-3 * a.force);
}

TEST(Tled, GoesOnFromARestoredState) {
  const LiverSlab slab("tled");
  const auto whole = slab.make(), halves = slab.make();
  LiverPress a(0.008, 0.1), b(0.008, 0.1);
  for (int k = 0; k < 8; ++k) {
    whole->step({a.next()}, kStep);
    halves->step({b.next()}, kStep);
  }
  const Points x = halves->positions(), v = halves->velocities();
  halves->reset();
  halves->setPositions(0, x, v);
  for (int k = 0; k < 5; ++k) {
    const Vec3 f = test::onTool(whole->step({a.next()}, kStep));
    const Vec3 g = test::onTool(halves->step({b.next()}, kStep));
    EXPECT_LT((f - g).norm(), 0.05 * f.norm());
  }
}

TEST(Tled, TakesSeveralTools) {
  LiverSlab slab("tled");
  slab.settings.mass_damping = 30.0;
  const auto tissue = slab.make();
  const instrument::Geometry left = instrument::Sphere{0.008};
  const instrument::Geometry right = instrument::Box{Vec3(0.008, 0.008, 0.008)};
  const auto at = [](double x, double z) { return poseFromXyzRpy(Vec3(x, 0.05, z), Vec3::Zero()); };
  Vec3 on_left = Vec3::Zero(), on_right = Vec3::Zero();
  for (int k = 0; k < 60; ++k) {
    const double z = 0.05 - 1e-3 * std::min(k, 8), to = 0.05 - 1e-3 * std::min(k + 1, 8);
    const TissueStep& step = tissue->step(
        {{&left, 0, at(0.025, z), at(0.025, to)}, {&right, 1, at(0.075, z), at(0.075, to)}}, kStep);
    ASSERT_TRUE(step.ok());
    EXPECT_LT(test::imbalance(step).norm(), 1e-9);
    on_left = on_right = Vec3::Zero();
    for (const TissueContact& c : step.contacts)
      (c.owner.index == 0 ? on_left : on_right) += c.force_W;
  }
  EXPECT_GT(on_left.z(), 0.1);
  EXPECT_GT(on_right.z(), on_left.z());
}

// A scene that was reset while the tool was in the tissue.
TEST(Tled, PushesTissueOutOfAToolThatIsInItFromTheBegin) {
  LiverSlab slab("tled");
  slab.settings.mass_damping = 30.0;
  const auto tissue = slab.make();
  const instrument::Geometry ball = instrument::Sphere{0.01};
  const Pose X = poseFromXyzRpy(Vec3(0.05, 0.05, 0.048), Vec3::Zero());
  TissueStep step;
  for (int k = 0; k < 60; ++k) {
    step = tissue->step({{&ball, 0, X, X}}, kStep);
    ASSERT_TRUE(std::isfinite(energy(step)));
    EXPECT_LT(energy(step), 0.5);
  }
  EXPECT_TRUE(step.ok());
  const double force = pressAndHold(slab, 1.0, kStep, 0.002).force;
  EXPECT_NEAR(test::onTool(step).z(), force, 0.02 * force);
}

TEST(Tled, AThinFastToolDoesNotPassThrough) {
  LiverSlab slab("tled");
  slab.settings.sample_spacing = 0.0005;
  const auto tissue = slab.make();
  const instrument::Geometry needle = instrument::Capsule{0.001, 0.03};
  const auto at = [](double z) {
    return poseFromXyzRpy(Vec3(0.05, 0.05, z), Vec3(0.0, M_PI / 2, 0.0));
  };
  double z = 0.05;
  for (int k = 0; k < 6; ++k) {
    const TissueStep& step = tissue->step({{&needle, 0, at(z), at(z - 0.005)}}, kStep);
    z -= 0.005;
    ASSERT_TRUE(std::isfinite(energy(step)));
    double highest = 0.0;  // of the tissue under the needle's middle
    for (Eigen::Index i = 0; i < slab.mesh.numPoints(); ++i) {
      const Vec3 X = slab.mesh.points.col(i);
      if (std::hypot(X.x() - 0.05, X.y() - 0.05) < 1e-9) {
        highest = std::max(highest, tissue->positions()(2, i));
      }
    }
    EXPECT_LT(highest, std::max(z + 0.001, 0.041));
  }
}

TEST(Tled, RelaxesLikeTheImplicitMethod) {
  LiverSlab a("tled", Eigen::Vector3i(5, 5, 3)), b("implicit_pcg", Eigen::Vector3i(5, 5, 3));
  for (LiverSlab* slab : {&a, &b}) {
    slab->prony = {{0.5, 0.2}};
    slab->settings.mass_damping = 30.0;
  }
  const double early = pressAndHold(a, 0.2, kStep).force;
  const double late = pressAndHold(a, 1.5, kStep).force;
  EXPECT_LT(late, 0.8 * early);
  EXPECT_NEAR(late, pressAndHold(b, 1.5, kStep).force, 0.005 * late);
}

TEST(Tled, KeepsItsLastGoodStateWhenACycleFails) {
  const LiverSlab slab("tled");
  const auto tissue = slab.make();
  const Points good = tissue->positions();
  Points bad = tissue->velocities();
  bad(0, slab.mesh.numPoints() - 1) = std::numeric_limits<double>::infinity();
  tissue->setPositions(0, good, bad);
  EXPECT_FALSE(tissue->step({}, kStep).ok());
  EXPECT_EQ(tissue->positions(), good);
  EXPECT_TRUE(tissue->velocities().isZero());
  EXPECT_TRUE(tissue->step({}, kStep).ok());
}

TEST(Tled, RefusesWhatItCannotDo) {
  const auto refusal = [](const LiverSlab& slab) -> std::string {
    try {
      slab.make();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  for (const char* integrator : {"static", "bdf2"}) {
    LiverSlab slab("tled");
    slab.settings.integrator = integrator;
    EXPECT_TRUE(test::contains(refusal(slab), std::string("integrator = ") + integrator));
  }
  LiverSlab damped("tled");
  damped.settings.stiffness_damping = 0.01;
  EXPECT_TRUE(test::contains(refusal(damped), "damping.stiffness = 0.01"));
}

}  // namespace
}  // namespace palpate::tissue::tled_method_test
