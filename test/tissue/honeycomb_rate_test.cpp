// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "model_variants.h"

namespace palpate::tissue::honeycomb_rate_test {
namespace {

using test::kStep;

// 1000 cells, pushed and dragged, for comparison with about 100 Hz on a processor of 2 GHz [Wang
// 2005, 3.5]. No time is a failure.
TEST(HoneycombRate, OfAThousandCells) {
  const auto bottom = [](const Vec3& X) { return X.z() <= 0.0; };
  for (const double threshold : {1e-6, 1e-5}) {
    for (const double cut_off : {0.0, 1e-4}) {
      test::OrganSketch organ = test::block("cube", Vec3::Zero(), Vec3::Constant(0.1),
                                            Eigen::Vector3i(10, 10, 10), bottom);
      organ.honeycomb.threshold = threshold;
      organ.honeycomb.cut_off = cut_off;
      ModelSettings scene = test::variantSettings();
      scene.gravity.setZero();
      const auto tissue = test::makeOrgans({organ}, scene, nullptr, "honeycomb");
      const instrument::Geometry ball = instrument::Sphere{0.01};
      const auto at = [](double t) {
        const double down = std::min(0.05 * t, 0.01), aside = std::max(0.0, 0.04 * (t - 0.3));
        return poseFromXyzRpy(Vec3(0.045 + aside, 0.05, 0.1105 - down), Vec3::Zero());
      };
      double whole = 0.0, worst = 0.0, peak = 0.0;
      int waves = 0, cycles = 0, failed = 0;
      for (double t = 0.0; t < 0.6; t += kStep) {
        const auto begin = std::chrono::steady_clock::now();
        const TissueStep& step = tissue->step({{&ball, 0, at(t), at(t + kStep)}}, kStep);
        const double took =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        failed += !step.ok();
        peak = std::max(peak, test::onTool(step).z());
        waves += step.newton_iterations;
        whole += took;
        worst = std::max(worst, took);
        ++cycles;
      }
      EXPECT_EQ(tissue->cells(0).numCells(), 1000);
      std::printf(
          "1000 cells, threshold %.0e m, cut off %.0e m: %.1f ms a cycle (%.0f Hz), worst "
          "%.1f ms, %.1f waves, %d of %d failed, at most %.3f N\n",
          threshold, cut_off, 1e3 * whole / cycles, cycles / whole, 1e3 * worst,
          static_cast<double>(waves) / cycles, failed, cycles, peak);
    }
  }
}

}  // namespace
}  // namespace palpate::tissue::honeycomb_rate_test
