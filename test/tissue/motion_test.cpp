// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

#include "support/contains.h"

namespace palpate::tissue::motion_test {
namespace {

const Vec3 kWay(0.003, -0.004, 0.012);

Motion wave(const std::string& form, double phase = 0.0) {
  Wave w;
  w.form = form;
  w.amplitude = kWay;
  w.period = 4.0;
  w.phase = phase;
  return Motion(w);
}

MotionTable table(bool periodic) {
  MotionTable t;
  t.t = {0.0, 1.0, 1.5, 3.0, 4.0};
  t.at.resize(3, 5);
  t.at << 1.0, 2.0, 2.5, -1.0, 1.0,  //
      0.0, 1.0, 2.25, 9.0, 0.0,      //
      5.0, 5.0, 5.0, 5.0, 5.0;
  t.periodic = periodic;
  return t;
}

// Largest difference of slopes across a millionth of a second, anywhere.
double leapOfVelocity(const Motion& motion) {
  constexpr double h = 1e-6;
  double largest = 0.0;
  for (int k = 0; k <= 4800; ++k) {
    const double t = 0.0025 * k;
    const Vec3 before = t > h ? Vec3((motion.at(t) - motion.at(t - h)) / h) : Vec3::Zero();
    largest = std::max(largest, ((motion.at(t + h) - motion.at(t)) / h - before).norm());
  }
  return largest;
}

TEST(Motions, BeginAtRestAndNeverLeap) {
  for (const Motion& motion : {wave("sine"), wave("sine", 0.3), wave("cos4"), wave("cos4", 0.5),
                               Motion(table(true)), Motion(table(false))}) {
    EXPECT_EQ(motion.at(0.0), Vec3::Zero());
    // Accelerations are below 100 here: over 2e-6 s.
    EXPECT_LT(leapOfVelocity(motion), 1e-3);
  }
}

TEST(Motions, OfAWaveAreTheirFormulaAfterAPeriod) {
  for (const double t : {4.0, 4.7, 5.3, 9.1}) {
    EXPECT_LT((wave("sine").at(t) - std::sin(M_PI / 2.0 * t) * kWay).norm(), 1e-15);
    // Lujan's z0 - b cos^4(pi t/tau - phi), turned round, at rest where t is whole cycles.
    EXPECT_LT((wave("cos4").at(t) - std::pow(std::sin(M_PI / 4.0 * t), 4.0) * kWay).norm(), 1e-15);
    EXPECT_LT((wave("cos4", 0.25).at(t) - wave("cos4").at(t + 1.0)).norm(), 1e-15);
  }
  EXPECT_LT((wave("cos4").at(6.0) - kWay).norm(), 1e-15);
}

TEST(Motions, OfATableGoThroughItsRowsAndParabolas) {
  const MotionTable t = table(false);
  const Motion motion(t);
  for (Eigen::Index k = 0; k < t.at.cols(); ++k) {
    EXPECT_LT((motion.at(t.t[static_cast<std::size_t>(k)]) - (t.at.col(k) - t.at.col(0))).norm(),
              1e-12);
  }
  // The second column is t^2 but at its end: between rows with parabolas on both sides exactly so.
  EXPECT_NEAR(motion.at(1.2).y(), 1.44, 1e-12);
  EXPECT_EQ(motion.at(77.0), motion.at(4.0));
}

TEST(Motions, OfAPeriodicTableComeBack) {
  const Motion motion(table(true));
  EXPECT_LT((motion.at(5.2) - motion.at(9.2)).norm(), 1e-12);
  EXPECT_LT(motion.at(8.0).norm(), 1e-12);
}

TEST(Motions, SayWhatIsWrongWithATable) {
  const auto errorOf = [](const std::function<void(MotionTable*)>& change) -> std::string {
    MotionTable t = table(true);
    change(&t);
    try {
      Motion motion(t);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(errorOf([](MotionTable*) {}), "");
  EXPECT_EQ(errorOf([](MotionTable* t) { t->t[0] = 0.1; }), "must begin at t = 0");
  EXPECT_EQ(errorOf([](MotionTable* t) { t->t[2] = t->t[1]; }), "times must increase");
  EXPECT_EQ(errorOf([](MotionTable* t) { t->at(0, 4) = 2.0; }),
            "must end where it begins to be periodic");
  EXPECT_EQ(errorOf([](MotionTable* t) { t->t.resize(1), t->at.conservativeResize(3, 1); }),
            "must have two rows at least");
  EXPECT_EQ(errorOf([](MotionTable* t) { t->at(1, 1) = NAN; }), "must be finite numbers");
  Wave w;
  w.form = "square";
  EXPECT_THROW(Motion{w}, std::invalid_argument);
}

}  // namespace
}  // namespace palpate::tissue::motion_test
