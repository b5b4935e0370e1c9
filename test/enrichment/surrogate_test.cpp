// SPDX-License-Identifier: GPL-3.0-or-later
// Surrogates of a body whose answer is known in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "palpate/base/atomic_file.h"
#include "palpate/base/text_file.h"
#include "palpate/enrichment/surrogate_file.h"
#include "palpate/enrichment/surrogate_training.h"
#include "palpate/organs/organs.h"
#include "support/input_error.h"
#include "support/temp_folder.h"

namespace palpate::enrichment::surrogate_test {
namespace {

// Stiffer to the right, and the farther it is displaced; all points move along, those far less.
Vec3 forceOf(const Vec3& place, const Vec3& d) {
  return (100.0 + 500.0 * place.x() + 2e4 * d.norm()) * d;
}

DeformationDatabase springBed(int samples) {
  DeformationDatabase database;
  database.coarse = database.fine = organs::makeOrgan("slab", 0.03);
  database.made_by = "organ, edges 0.01 m, patch 0.006 m, seed 1";
  const Points& X = database.fine.points;
  for (int k = 0; k < samples; ++k) {
    Deformation sample;
    sample.contact = static_cast<int>((7L * k) % X.cols());
    const Vec3 place = X.col(sample.contact);
    const Vec3 d = 0.004 * (0.3 + 0.7 * std::abs(std::sin(1.3 * k))) *
                   Vec3(0.4 * std::sin(2.1 * k), 0.4 * std::sin(3.7 * k + 1.0), -1.0).normalized();
    sample.force = forceOf(place, d);
    sample.fine.resize(3, X.cols());
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
      sample.fine.col(i) = d * std::exp(-(X.col(i) - place).squaredNorm() / (2.0 * 0.04 * 0.04));
    }
    database.samples.push_back(sample);
  }
  return database;
}

TrainingSettings settingsOf(const std::string& kind) {
  TrainingSettings settings;
  settings.kind = kind;
  settings.hidden = {kind == "kernel" ? 48 : 16};  // a centre at each sample
  settings.modes = 20;
  settings.iterations = 600;
  return settings;
}

class OfKind : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Kinds, OfKind, ::testing::Values("kernel", "network"));

// A stiffness that is smooth over the body is to be found within 5 %, where it was not learned.
TEST_P(OfKind, LearnsAClosedForm) {
  const DeformationDatabase database = springBed(150);
  std::vector<Deformation> held_out, learned;
  const Surrogate made = trainSurrogate(database, settingsOf(GetParam()), &held_out, &learned);
  EXPECT_EQ(held_out.size() + learned.size(), 150U);
  EXPECT_NEAR(static_cast<double>(held_out.size()), 30.0, 5.0);
  for (const Deformation& out : held_out) {
    for (const Deformation& in : learned) ASSERT_NE(out.contact, in.contact);
  }
  const SurrogateError error = errorOf(made, database, held_out);
  std::printf("%s: force %.2f %%, displacement %.4f mm\n", GetParam(), 100 * error.relative_force,
              1e3 * error.displacement);
  EXPECT_LT(error.relative_force, 0.05);
  EXPECT_LT(error.median_force, 0.05);
}

TEST_P(OfKind, IsTheSameBitsAndHasNoForceAtRest) {
  const DeformationDatabase database = springBed(60);
  Surrogate a = trainSurrogate(database, settingsOf(GetParam()));
  Surrogate b = trainSurrogate(database, settingsOf(GetParam()));
  Eigen::VectorXd work, modes_a, modes_b;
  Vec3 force_a, force_b;
  const Vec3 place = database.fine.points.col(4);
  for (const Vec3& d : {Vec3(0.0, 0.0, 0.0), Vec3(0.001, 0.0, -0.002), Vec3(5.0, 3.0, 1.0)}) {
    a.predict(place, d, &work, &force_a, &modes_a);
    b.predict(place, d, &work, &force_b, &modes_b);
    EXPECT_EQ(force_a, force_b);
    EXPECT_EQ(modes_a, modes_b);
    EXPECT_TRUE(force_a.allFinite());
    EXPECT_EQ(force_a.isZero(0.0), d.isZero(0.0));
  }
}

TEST_P(OfKind, KnowsWhatItHasNotSeen) {
  const DeformationDatabase database = springBed(150);
  std::vector<Deformation> held_out;
  const Surrogate made = trainSurrogate(database, settingsOf(GetParam()), &held_out);
  int strange = 0, far = 0;
  for (const Deformation& sample : held_out) {
    const Vec3 place = database.fine.points.col(sample.contact);
    const Vec3 d = sample.fine.col(sample.contact);
    strange += made.strangeness(place, d) > 1.0;
    EXPECT_LE(made.strangeness(place, 0.5 * d), made.strangeness(place, d) + 1e-12);
    far += made.strangeness(place + Vec3(0.0, 0.0, 1.0), d) > 1.0;
  }
  EXPECT_LE(strange, 6);
  EXPECT_EQ(far, static_cast<int>(held_out.size()));
}

// Of 40 that are right and 20 that are wrong, farther by chance: at most a tenth of these is let
// by.
TEST(SetThreshold, FlagsNineTenthsOfWhatIsWrong) {
  SurrogateError error;
  for (int k = 0; k < 60; ++k) {
    error.part.push_back(k % 3 == 0 ? 0.5 : 0.1);
    error.strangeness.push_back((k % 3 == 0 ? 0.6 : 0.2) + 0.1 * std::sin(1.7 * k));
  }
  Surrogate surrogate;
  surrogate.seen.threshold = 3.0;
  setThreshold({error}, &surrogate);
  const double threshold = surrogate.seen.threshold / 3.0;
  const Alarms alarms = alarmsOf({error}, threshold);
  EXPECT_EQ(alarms.wrong, 20);
  EXPECT_EQ(alarms.right, 40);
  EXPECT_GE(alarms.flagged, 18);
  EXPECT_EQ(alarms.false_alarms, 0);
  EXPECT_LE(threshold, 0.3);  // no farther than what was right
}

TEST_P(OfKind, IsReadAsItWasWrittenAndRefusedOtherwise) {
  const test::TempFolder temp;
  const DeformationDatabase database = springBed(40);
  Surrogate made = trainSurrogate(database, settingsOf(GetParam()));
  const std::string file = temp.path("a.net"), other = temp.path("b.net");
  writeSurrogate(file, made);
  Surrogate read = readSurrogate(file);
  writeSurrogate(other, read);
  const std::string bytes = readTextFile(file, 1U << 26);
  EXPECT_EQ(bytes, readTextFile(other, 1U << 26));
  EXPECT_EQ(read.made_by, made.made_by);
  for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 50) {
    writeFileAtomically(other, bytes.substr(0, size));
    EXPECT_THROW(readSurrogate(other), InputError) << size;
    std::string changed = bytes;
    changed[size] = static_cast<char>(changed[size] ^ 0x11);
    writeFileAtomically(other, changed);
    EXPECT_THROW(readSurrogate(other), InputError) << size;
  }
}

// Finite numbers of which an answer is not: a hand would feel it.
TEST_P(OfKind, IsRefusedWhereAnAnswerWouldOverflow) {
  const test::TempFolder temp;
  const Surrogate made = trainSurrogate(springBed(40), settingsOf(GetParam()));
  const std::string file = temp.path("a.net");
  const auto refused = [&](const auto& change) {
    Surrogate changed = made;
    change(&changed);
    writeSurrogate(file, changed);
    return !test::complaint([&] { readSurrogate(file); }).empty();
  };
  EXPECT_FALSE(refused([](Surrogate*) {}));
  for (const double value : {1e200, -1e200, std::nan("")}) {
    EXPECT_TRUE(refused([&](Surrogate* s) { s->force_scale = value; })) << value;
    EXPECT_TRUE(refused([&](Surrogate* s) { s->plain(2, 1) = value; })) << value;
    EXPECT_TRUE(refused([&](Surrogate* s) { s->surface.points(0, 0) = value; })) << value;
    EXPECT_TRUE(refused([&](Surrogate* s) { s->seen.samples(5, 0) = value; })) << value;
  }
  EXPECT_TRUE(refused([](Surrogate* s) { s->scale[3] = 1e-200; }));
  EXPECT_TRUE(refused([](Surrogate* s) { s->scale[3] = 1e200; }));
  EXPECT_TRUE(refused([](Surrogate* s) { s->displacement_scale = 1e-200; }));
  EXPECT_TRUE(refused([](Surrogate* s) {
    if (auto* kernel = std::get_if<KernelMap>(&s->map)) {
      Eigen::MatrixXd weights = kernel->weights();
      weights(1, 2) = 1e200;
      *kernel = KernelMap(kernel->inputs(), kernel->displacements(), weights);
    } else {
      auto& network = std::get<Perceptron>(s->map);
      Eigen::VectorXd parameters = network.parameters();
      parameters[7] = 1e200;
      network.setParameters(parameters);
    }
  }));
}

TEST(SurrogateTraining, RefusesWhatItCannotLearn) {
  EXPECT_THROW(trainSurrogate(springBed(9), settingsOf("kernel")), std::invalid_argument);
  DeformationDatabase database = springBed(40);
  database.made_by = "somehow";
  EXPECT_THROW(trainSurrogate(database, settingsOf("kernel")), std::invalid_argument);
  EXPECT_THROW(trainSurrogate(springBed(40), settingsOf("forest")), std::invalid_argument);
}

TEST(SurrogateTraining, SaysWhichSettingIsNone) {
  const struct {
    void (*spoil)(TrainingSettings*);
    const char* said;
  } cases[] = {{[](TrainingSettings* s) { s->modes = 0; }, "modes must be at least 1"},
               {[](TrainingSettings* s) { s->held_out = 1.0; }, "holdout must be in [0, 1)"},
               {[](TrainingSettings* s) { s->held_out = NAN; }, "holdout must be in [0, 1)"},
               {[](TrainingSettings* s) { s->iterations = 0; }, "iterations must be at least 1"},
               {[](TrainingSettings* s) { s->decay = -1.0; }, "decay must be at least 0"}};
  for (const auto& of : cases) {
    TrainingSettings settings = settingsOf("network");
    of.spoil(&settings);
    try {
      trainSurrogate(springBed(40), settings);
      ADD_FAILURE() << of.said;
    } catch (const std::invalid_argument& error) {
      EXPECT_STREQ(error.what(), of.said);
    }
  }
}

TEST(RankCorrelation, IsOfTheOrderAlone) {
  EXPECT_DOUBLE_EQ(rankCorrelation({1.0, 2.0, 3.0}, {1.0, 10.0, 100.0}), 1.0);
  EXPECT_DOUBLE_EQ(rankCorrelation({1.0, 2.0, 3.0}, {3.0, 2.0, 1.0}), -1.0);
  EXPECT_EQ(rankCorrelation({1.0, 1.0}, {1.0, 2.0}), 0.0);
}

}  // namespace
}  // namespace palpate::enrichment::surrogate_test
