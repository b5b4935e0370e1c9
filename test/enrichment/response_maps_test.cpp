// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "palpate/enrichment/kernel_map.h"
#include "palpate/enrichment/perceptron.h"
#include "support/allocations.h"

namespace palpate::enrichment {
namespace {

// The same on every machine that has the same sine.
ResponseSamples someSamples(Eigen::Index n, Eigen::Index outputs) {
  ResponseSamples samples;
  samples.inputs.resize(6, n);
  samples.displacements.resize(3, n);
  samples.values.resize(outputs, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    for (Eigen::Index i = 0; i < 6; ++i) {
      samples.inputs(i, k) = std::sin(1.7 * static_cast<double>((k + 1) * (i + 2)));
    }
    samples.displacements.col(k) = 0.7 * samples.inputs.col(k).tail<3>();
    for (Eigen::Index r = 0; r < outputs; ++r) {
      samples.values(r, k) =
          std::cos(samples.inputs(0, k) + static_cast<double>(r)) * samples.displacements(r % 3, k);
    }
  }
  return samples;
}

TEST(Perceptron, HasTheDerivativeOfItsLoss) {
  for (const std::vector<int>& hidden : {std::vector<int>{}, {5}, {4, 6}}) {
    Perceptron network(hidden, 4, 3);
    Eigen::VectorXd at = network.parameters();
    for (Eigen::Index k = 0; k < at.size(); ++k) at[k] += 0.3 * std::sin(static_cast<double>(k));
    const ResponseSamples samples = someSamples(7, 4);
    Eigen::VectorXd gradient, unused;
    network.setParameters(at);
    network.loss(samples, 0.01, &gradient);
    const double h = 1e-5;
    for (Eigen::Index k = 0; k < at.size(); ++k) {
      const auto value = [&](double step) {
        Eigen::VectorXd moved = at;
        moved[k] += step;
        network.setParameters(moved);
        return network.loss(samples, 0.01, &unused);
      };
      // The differences' error is of the order h^2 = 1e-10, of rounding 1e-16/h = 1e-11.
      EXPECT_NEAR((value(h) - value(-h)) / (2.0 * h), gradient[k], 1e-8) << k;
    }
  }
}

TEST(Perceptron, LosesWhatItsPredictionsMiss) {
  Perceptron network({5, 4}, 4, 1);
  Eigen::VectorXd parameters = network.parameters();
  parameters.array() += 0.1;
  network.setParameters(parameters);
  const ResponseSamples samples = someSamples(9, 4);
  Eigen::VectorXd gradient, y;
  double sum = 0.0;
  for (Eigen::Index k = 0; k < 9; ++k) {
    network.evaluate(samples.inputs.col(k), samples.displacements.col(k), 4, &y);
    sum += (y - samples.values.col(k)).squaredNorm();
  }
  EXPECT_NEAR(network.loss(samples, 0.0, &gradient), sum / 9.0, 1e-14);
}

// With a centre at each sample, and hardly a ridge, a sample is its own prediction.
TEST(KernelMap, PassesThroughItsSamples) {
  const ResponseSamples samples = someSamples(12, 5);
  const KernelMap map = KernelMap::fit(samples, 12, 1e-10);
  Eigen::VectorXd y;
  for (Eigen::Index k = 0; k < 12; ++k) {
    map.evaluate(samples.inputs.col(k), samples.displacements.col(k), 5, &y);
    EXPECT_LT((y - samples.values.col(k)).norm(), 1e-5) << k;
  }
}

TEST(KernelMap, LeavesOutAsIfAGroupHadNotBeenThere) {
  const ResponseSamples samples = someSamples(9, 3);
  const double ridge = 0.05;
  const std::vector<int> groups{4, 1, 1, 7, 4, 4, 2, 7, 3};
  double sum = 0.0;
  for (const int group : {1, 2, 3, 4, 7}) {
    std::vector<Eigen::Index> in, out;
    for (Eigen::Index k = 0; k < 9; ++k) {
      (groups[static_cast<std::size_t>(k)] == group ? out : in).push_back(k);
    }
    const auto n = static_cast<Eigen::Index>(in.size());
    ResponseSamples others;
    others.inputs.resize(6, n);
    others.displacements.resize(3, n);
    others.values.resize(3, n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const Eigen::Index at = in[static_cast<std::size_t>(k)];
      others.inputs.col(k) = samples.inputs.col(at);
      others.displacements.col(k) = samples.displacements.col(at);
      others.values.col(k) = samples.values.col(at);
    }
    const KernelMap map = KernelMap::fit(others, n, ridge);
    Eigen::VectorXd y;
    for (const Eigen::Index k : out) {
      map.evaluate(samples.inputs.col(k), samples.displacements.col(k), 3, &y);
      sum += (y - samples.values.col(k)).squaredNorm();
    }
  }
  EXPECT_NEAR(leaveGroupsOutError(samples, ridge, groups), sum, 1e-9 * sum);
}

TEST(ResponseMaps, AnswerNothingToNothingAndAllocateNothing) {
  const ResponseSamples samples = someSamples(20, 6);
  const KernelMap kernel = KernelMap::fit(samples, 20, 1e-3);
  Perceptron network({8, 8}, 6, 1);
  Eigen::VectorXd y(6);
  const Vec6 x = samples.inputs.col(3);
  test::countAllocations(true);
  kernel.evaluate(x, Vec3::Zero(), 6, &y);
  const double of_kernel = y.norm();
  network.evaluate(x, Vec3::Zero(), 6, &y);
  test::countAllocations(false);
  EXPECT_EQ(of_kernel, 0.0);
  EXPECT_EQ(y.norm(), 0.0);
  EXPECT_EQ(test::allocations(), 0U);
}

}  // namespace
}  // namespace palpate::enrichment
