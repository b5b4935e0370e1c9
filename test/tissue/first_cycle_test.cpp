// SPDX-License-Identifier: GPL-3.0-or-later
// What a first cycle needs, as a factorisation, is made while loading, and where the tissue is put.
#include <gtest/gtest.h>

#include <string>

#include "slab.h"

namespace palpate::tissue::first_cycle_test {
namespace {

using test::kStep;
using test::Slab;

class MethodThatFactorises : public ::testing::TestWithParam<std::string> {
 public:
  MethodThatFactorises() : slab(Eigen::Vector3i(6, 6, 3)) {
    slab.settings.method = GetParam();
    tissue = slab.make();
  }
  std::size_t memory() const { return tissue->state().bytes.size(); }

  Slab slab;
  std::unique_ptr<TissueModel> tissue;
};
INSTANTIATE_TEST_SUITE_P(Methods, MethodThatFactorises,
                         ::testing::Values("lbfgs", "implicit_async"),
                         [](const auto& name) { return name.param; });

// A factor is a part of the state, the largest by far.
TEST_P(MethodThatFactorises, HasDoneSoBeforeTheFirstCycle) {
  const Points x = tissue->positions();
  const std::size_t loaded = memory();
  tissue->reset();
  EXPECT_EQ(memory(), loaded);
  tissue->setPositions(0, x, Points::Zero(3, x.cols()));
  EXPECT_EQ(memory(), loaded);
  tissue->step({}, kStep);
  EXPECT_NEAR(static_cast<double>(memory()), loaded, 0.1 * loaded);
}

}  // namespace
}  // namespace palpate::tissue::first_cycle_test
