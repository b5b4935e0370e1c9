// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/prony_history.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/random.h"

namespace palpate::fem::prony_history_test {
namespace {

constexpr int kElements = 23, kPoints = 4;

// Solid 0 is viscous in two terms, solid 1 is not, solid 2 is in one.
class History : public ::testing::Test {
 protected:
  History() {
    const material::Material law =
        material::makeMaterial("neo_hookean", {{"mu", {2e3}}, {"kappa", {2e4}}});
    composition.solids = {
        {law, 1000.0, {{0.3, 0.1}, {0.2, 1.0}}}, {law, 1000.0, {}}, {law, 1000.0, {{0.4, 0.05}}}};
    runs.resize(3);
    for (int s = 0; s < 3; ++s) runs[s].solid = s;
    for (int e = 0; e < kElements; ++e) {
      composition.solid_of.push_back(e / 2 % 3);
      runs[e / 2 % 3].elements.push_back(e);
    }
  }

  PronyHistory make(ThreadPool* pool = nullptr) const {
    return PronyHistory(composition, runs, kElements, kPoints, pool);
  }
  bool viscous(int e) const { return !composition.solid(e).prony.empty(); }
  // Stress of each point, always other ones.
  std::vector<Mat3> stresses() {
    std::vector<Mat3> S(kElements * kPoints);
    for (Mat3& at : S) {
      const Mat3 A = random.matrix(1e3);
      at = A + A.transpose();
    }
    return S;
  }
  void set(const std::vector<Mat3>& S, PronyHistory* history) const {
    for (int e = 0; e < kElements; ++e) {
      for (int q = 0; q < kPoints && viscous(e); ++q) {
        history->setStressAtEnd(e, q, S[e * kPoints + q]);
      }
    }
  }
  void step(double h, const std::vector<Mat3>& S, PronyHistory* history) const {
    history->beginStep(h);
    set(S, history);
    history->endStep();
  }
  static std::string bytes(const PronyHistory& history) {
    StateWriter out;
    history.save(&out);
    return out.bytes();
  }

  Composition composition;
  std::vector<ElementRun> runs;
  test::Random random;
};

// The recursion point by point, as the formula of the class has it.
TEST_F(History, IsTheRecursionAtEveryPoint) {
  PronyHistory history = make();
  const std::vector<Mat3> S0 = stresses(), S1 = stresses(), S2 = stresses();
  set(S0, &history);
  history.relax();
  step(0.02, S1, &history);
  step(0.03, S2, &history);
  history.beginStep(0.01);
  for (int e = 0; e < kElements; ++e) {
    double factor = 1.0;
    for (const material::PronyTerm& term : composition.solid(e).prony) {
      factor -= term.g * (1.0 - (1.0 - std::exp(-0.01 / term.tau)) / (0.01 / term.tau));
    }
    EXPECT_NEAR(history.factor(composition.solid_of[e]), factor, 1e-13);
    for (int q = 0; q < kPoints; ++q) {
      const int i = e * kPoints + q;
      Mat3 H = Mat3::Zero();
      for (const material::PronyTerm& term : composition.solid(e).prony) {
        const auto decay = [&](double h) { return std::exp(-h / term.tau); };
        const auto gain = [&](double h) { return term.g * (1.0 - decay(h)) / (h / term.tau); };
        Mat3 Q = gain(0.02) * (S1[i] - S0[i]);
        Q = decay(0.03) * Q + gain(0.03) * (S2[i] - S1[i]);
        H += decay(0.01) * Q - gain(0.01) * S2[i];
      }
      EXPECT_LT((history.stress(e, q) - H).norm(), 1e-12 * S2[i].norm()) << e << " " << q;
    }
  }
  history.beginStep(std::numeric_limits<double>::infinity());
  EXPECT_NEAR(history.factor(0), 0.5, 1e-15);
  EXPECT_EQ(history.factor(1), 1.0);
  EXPECT_EQ(history.stress(0, 0).norm(), 0.0);
}

TEST_F(History, GivesTheSameBitsWithAllThreads) {
  const std::vector<Mat3> S0 = stresses(), S1 = stresses();
  PronyHistory alone = make();
  step(0.02, S0, &alone);
  step(0.03, S1, &alone);
  ThreadPool pool(2);
  PronyHistory shared = make(&pool);
  step(0.02, S0, &shared);
  step(0.03, S1, &shared);
  EXPECT_EQ(bytes(shared), bytes(alone));
}

TEST_F(History, GoesBackToEachStateThatWasKept) {
  PronyHistory history = make();
  step(0.02, stresses(), &history);
  const PronyHistory::State first = history.state();
  const std::string first_bytes = bytes(history);
  for (int trial = 0; trial < 3; ++trial) {
    step(0.01, stresses(), &history);
    const PronyHistory::State second = history.state();
    const std::string second_bytes = bytes(history);
    EXPECT_NE(second_bytes, first_bytes);
    step(0.01, stresses(), &history);
    step(0.01, stresses(), &history);
    history.setState(second);
    EXPECT_EQ(bytes(history), second_bytes);
    history.setState(first);
    EXPECT_EQ(bytes(history), first_bytes);
  }
}

TEST_F(History, OfBytesIsTheSame) {
  PronyHistory history = make(), other = make();
  step(0.02, stresses(), &history);
  history.beginStep(0.01);
  const std::string saved = bytes(history);
  StateReader in(saved);
  other.restore(&in);
  in.finish();
  EXPECT_EQ(bytes(other), saved);
  const std::vector<Mat3> S = stresses();
  step(0.03, S, &history);
  step(0.03, S, &other);
  EXPECT_EQ(bytes(other), bytes(history));

  StateReader cut(std::string_view(saved).substr(0, saved.size() - 8));
  EXPECT_THROW(other.restore(&cut), std::invalid_argument);
}

TEST_F(History, GoesToPartsAndToWhatIsJoined) {
  PronyHistory old = make();
  step(0.02, stresses(), &old);
  old.beginStep(0.01);
  mesh::MeshChange change;  // elements 6 and 7 change places, 12 becomes 12 and 13 together
  std::vector<double> volumes(kElements, 1.0);
  volumes[13] = 3.0;
  for (int e = 0; e < kElements; ++e) change.tets.push_back({e, e + 1});
  std::swap(change.tets[6], change.tets[7]);
  change.tets[12].last = 14;
  change.new_nodes.setZero(10, kElements);
  change.corners.assign(kElements + 1, Eigen::Matrix4d::Identity());
  change.corners[12].col(1) << 0.75, 0.25, 0.0, 0.0;
  change.corners[13].col(0) = change.corners[12].col(1);
  PronyHistory history = make();
  history.goOnFrom(old, change, volumes);
  EXPECT_EQ(history.factor(0), old.factor(0));
  const auto expect_all = [&] {
    Mat3 sum = Mat3::Zero(), of_parts = Mat3::Zero();
    for (int q = 0; q < kPoints; ++q) {
      EXPECT_TRUE(history.stress(0, q) == old.stress(0, q));
      EXPECT_TRUE(history.stress(6, q) == old.stress(7, q));
      sum += history.stress(12, q);
      of_parts += 0.25 * old.stress(12, q) + 0.75 * old.stress(13, q);
    }
    EXPECT_LT((sum - of_parts).norm(), 1e-13 * sum.norm());
  };
  expect_all();
  history.beginStep(0.01);  // from S and Q, which came along
  expect_all();
  change.tets[0] = {2, 3};  // of a solid that is not viscous
  EXPECT_THROW(history.goOnFrom(old, change, volumes), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::fem::prony_history_test
