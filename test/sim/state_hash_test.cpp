// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/sim/state_hash.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>
#include <set>
#include <string>
#include <vector>

#include "palpate/base/phase_times.h"
#include "palpate/sim/lockstep.h"
#include "slab_scene.h"

namespace palpate::sim::state_hash_test {
namespace {

std::uint64_t hashOf(const std::vector<double>& values) {
  StateHash hash;
  hash.add(values.data(), values.size());
  return hash.value();
}

// The formula of the header, word by word.
TEST(StateHash, IsItsFormula) {
  const std::vector<double> values = {1.0, -2.5, 3e-300, 0.0, 7.0, -0.0};
  const auto mixed = [](std::uint64_t h, std::uint64_t word) {
    h = (h ^ word) * 1099511628211ULL;
    return h ^ (h >> 32);
  };
  constexpr std::uint64_t kBasis = 14695981039346656037ULL;
  std::uint64_t lanes[4];
  for (std::uint64_t k = 0; k < 4; ++k) lanes[k] = mixed(kBasis, k);
  for (std::size_t k = 0; k < values.size(); ++k) {
    std::uint64_t word;
    std::memcpy(&word, &values[k], sizeof word);
    lanes[k % 4] = mixed(lanes[k % 4], word);
  }
  std::uint64_t expected = mixed(kBasis, values.size() % 4);
  for (const std::uint64_t lane : lanes) expected = mixed(expected, lane);
  EXPECT_EQ(hashOf(values), expected);
}

TEST(StateHash, OfPartsIsThatOfTheWhole) {
  const std::vector<double> values = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0};
  for (std::size_t cut = 0; cut <= values.size(); ++cut) {
    StateHash hash;
    hash.add(values.data(), cut);
    hash.add(values.data() + cut, values.size() - cut);
    EXPECT_EQ(hash.value(), hashOf(values)) << cut;
  }
}

// Every bit of every word, and the order of any two.
TEST(StateHash, ChangesWithEachBitAndWithTheOrder) {
  const std::vector<double> values = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};
  std::set<std::uint64_t> seen = {hashOf(values)};
  std::size_t tried = 1;
  for (std::size_t k = 0; k < values.size(); ++k) {
    for (int bit = 0; bit < 64; ++bit, ++tried) {
      std::vector<double> other = values;
      std::uint64_t word;
      std::memcpy(&word, &other[k], sizeof word);
      word ^= std::uint64_t{1} << bit;
      std::memcpy(&other[k], &word, sizeof word);
      seen.insert(hashOf(other));
    }
    for (std::size_t j = 0; j < k; ++j, ++tried) {
      std::vector<double> other = values;
      std::swap(other[j], other[k]);
      seen.insert(hashOf(other));
    }
  }
  EXPECT_EQ(seen.size(), tried);
  EXPECT_NE(hashOf({0.0}), hashOf({}));
}

class HashedRuns : public ::testing::Test {
 protected:
  std::vector<std::uint64_t> hashes(int threads, double aside = 0.0) const {
    scene::Scene scene = slab.scene();
    scene.solver.threads = threads;
    Simulator simulator(scene);
    Lockstep lockstep(&simulator);
    std::vector<std::uint64_t> all;
    double t = 0.0;
    for (Eigen::VectorXd q : test::SlabScene::press()) {
      q[1] += aside;
      all.push_back(lockstep.advance(t, {simulator.linkPoses(0, q)}).report.state_hash);
      t += 0.01;
    }
    return all;
  }
  test::SlabScene slab;
};

TEST_F(HashedRuns, AreTheSameForAnyThreadsAndInEachRun) {
  const std::vector<std::uint64_t> one = hashes(1);
  EXPECT_EQ(one, hashes(1));
  EXPECT_EQ(one, hashes(2));
  EXPECT_EQ(one, hashes(4));
  EXPECT_GT(std::set<std::uint64_t>(one.begin(), one.end()).size(), 100u);
}

TEST_F(HashedRuns, DifferWhereTheToolGoesTheLeastBitElsewhere) {
  const std::vector<std::uint64_t> one = hashes(1), other = hashes(1, 1e-12);
  EXPECT_EQ(one.front(), other.front());  // it does not touch yet
  EXPECT_NE(one[60], other[60]);
  EXPECT_NE(one.back(), other.back());
}

TEST_F(HashedRuns, AreTheSameWhereTheTimeGoesBack) {
  Simulator simulator(slab.scene());
  Lockstep lockstep(&simulator);
  std::vector<std::uint64_t> all[2];
  for (std::vector<std::uint64_t>& of_run : all) {
    double t = 0.0;
    for (const Eigen::VectorXd& q : test::SlabScene::press()) {
      of_run.push_back(lockstep.advance(t, {simulator.linkPoses(0, q)}).report.state_hash);
      t += 0.01;
    }
  }
  EXPECT_EQ(all[0], all[1]);
}

// Reports, without a check, the cost of the hash against that of a cycle.
TEST_F(HashedRuns, SayWhatTheHashCosts) {
  Simulator simulator(slab.scene());
  double cycles = 0.0;
  const std::vector<Eigen::VectorXd> press = test::SlabScene::press();
  for (int k = 30; k < 90; ++k) {
    cycles += simulator.step({simulator.linkPoses(0, press[k])}, 0.01).report.phases.cycle();
  }
  const tissue::SurfaceState shape = simulator.surfaceState(0);
  constexpr int kTimes = 20000;
  std::uint64_t sum = 0;
  const double begin = steadySeconds();
  for (int k = 0; k < kTimes; ++k) {
    StateHash hash;
    hash.add(static_cast<std::uint64_t>(k));
    hash.add(shape.positions.data(), static_cast<std::size_t>(shape.positions.size()));
    hash.add(shape.velocities.data(), static_cast<std::size_t>(shape.velocities.size()));
    sum += hash.value();
  }
  const double each = (steadySeconds() - begin) / kTimes, cycle = cycles / 60.0;
  std::printf("%td nodes: hash %.3g us, cycle %.4g us: %.3g %% (%d)\n", shape.positions.cols(),
              1e6 * each, 1e6 * cycle, 100.0 * each / cycle, static_cast<int>(sum & 1));
}

}  // namespace
}  // namespace palpate::sim::state_hash_test
