// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <vector>

#include "checks.h"
#include "palpate/base/percentiles.h"

namespace palpate::torture {
namespace {

constexpr double kTimesMedian = 100.0;
constexpr double kNoStall = 0.02;  // two default periods of a live scene [s]

class Time : public Criterion {
 public:
  explicit Time(const TortureScene& scene) : live_(scene.live) {}

  std::string check(const Cycle& cycle) override {
    const double seconds = cycle.result.report.phases.cycle() / std::max(cycle.parts, 1);
    longest_ = std::max(longest_, seconds);
    if (cycle.result.report.contacts > 0) touching_.push_back(seconds);
    return "";
  }

  std::string finish() override {
    if (live_ || touching_.empty() || longest_ <= kNoStall) return "";
    const double median = quantile(touching_, 0.5);
    if (longest_ <= kTimesMedian * median) return "";
    return said("a cycle took", 1e3 * longest_, "ms,") +
           said(" a median one in contact", 1e3 * median, "ms");
  }

 private:
  bool live_;
  double longest_ = 0.0;
  std::vector<double> touching_;
};

}  // namespace

std::unique_ptr<Criterion> checkTime(const TortureScene& scene) {
  return std::make_unique<Time>(scene);
}

}  // namespace palpate::torture
