// SPDX-License-Identifier: GPL-3.0-or-later
// Shipped scenes have the same states by all vector instructions that this processor has.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "base/detect_isas.h"
#include "sim/shipped_scenes.h"

namespace palpate {
namespace {

std::vector<Isa> available = detectIsas();
std::atomic<int> times_asked{0};

}  // namespace

// In place of the core's, which asks here for its kernels.
const std::vector<Isa>& availableIsas() {
  ++times_asked;
  return available;
}

namespace sim {
namespace {

// On a processor that has no more than `isa`.
std::vector<std::uint64_t> hashesBy(Isa isa, const std::string& scene) {
  available = detectIsas();
  while (available.back() > isa) available.pop_back();
  return test::hashesOf(scene);
}

class InstructionSets : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Scenes, InstructionSets, ::testing::ValuesIn(test::shippedScenes()),
                         [](const auto& name) { return name.param; });

TEST_P(InstructionSets, GiveTheSameStates) {
  const std::vector<Isa> isas = detectIsas();
  if (isas.size() < 2) GTEST_SKIP() << "this processor has the baseline's instructions only";
  const std::vector<std::uint64_t> hashes = hashesBy(Isa::kBaseline, GetParam());
  for (const Isa isa : isas) {
    if (isa == Isa::kBaseline) continue;
    EXPECT_EQ(hashesBy(isa, GetParam()), hashes) << toString(isa);
  }
}

TEST(AvailableIsas, AreThoseOfThisProgram) {
  times_asked = 0;
  hashesBy(Isa::kBaseline, "slab_probe");
  EXPECT_GT(times_asked, 0);
}

}  // namespace
}  // namespace sim
}  // namespace palpate
