// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "checks.h"

namespace palpate::torture {
namespace {

constexpr double kBackWithin = 1e-4;  // over the size

// Others have inverted equilibria: Green's strain, polar rotation and spring lengths do not detect
// inversion. Not checked if the last status is inverted.
bool hasOneRestState(const TortureOrgan& organ) {
  return organ.law != "st_venant_kirchhoff" && organ.law != "corotational" &&
         organ.model != "mass_spring";
}

// A sheet's springs know the distances of its points but not the side of a fold, so crumpled states
// may be at rest, too.
bool hasManyRestStates(const TortureOrgan& organ) { return organ.model == "cloth"; }

class Rest : public Criterion {
 public:
  Rest(const TortureScene& scene, const sim::Simulator& simulator)
      : simulator_(simulator), applies_(scene.rests), live_(scene.live), size_(scene.size()) {
    for (const TortureOrgan& organ : scene.organs) {
      one_ = one_ && hasOneRestState(organ);
      many_ = many_ || hasManyRestStates(organ);
    }
    for (int i = 0; i < simulator.numOrgans(); ++i) {
      rest_.push_back(simulator.positions(i));
      revision_.push_back(simulator.surfaceState(i).revision);
    }
    without_weight_ = scene.gravity.isZero();
  }

  std::string check(const Cycle& cycle) override {
    status_ = cycle.result.report.status;
    return "";
  }

  std::string finish() override {
    if (!applies_) return "";
    if (!one_ && status_ == solver::SolveStatus::kInverted) return "";
    double off = 0.0;
    for (int i = 0; i < simulator_.numOrgans() && !many_; ++i) off = std::max(off, offOf(i));
    std::string wrong;
    if (off > kBackWithin * size_) wrong = said("off by", 100.0 * off / size_, "% of its size");
    const bool cut = live_ && status_ == solver::SolveStatus::kDeadline;  // its status may be any
    if (!wrong.empty() || (!solver::balanced(status_) && !cut)) {
      wrong += (wrong.empty() ? "" : ", ") + std::string(solver::toString(status_));
    }
    return wrong;
  }

 private:
  double offOf(int i) const {
    const auto k = static_cast<std::size_t>(i);
    const Points& now = simulator_.positions(i);
    if (simulator_.surfaceState(i).revision == revision_[k])
      return (now - rest_[k]).cwiseAbs().maxCoeff();
    // After mesh adaptation: deviation from rest, without gravity.
    if (!without_weight_) return 0.0;
    return (now - simulator_.cells(i).points).cwiseAbs().maxCoeff();
  }

  const sim::Simulator& simulator_;
  bool applies_, live_, one_ = true, many_ = false, without_weight_ = true;
  double size_;
  std::vector<Points> rest_;
  std::vector<std::uint64_t> revision_;
  solver::SolveStatus status_ = solver::SolveStatus::kConverged;
};

}  // namespace

std::unique_ptr<Criterion> checkRest(const TortureScene& scene, const sim::Simulator& simulator) {
  return std::make_unique<Rest>(scene, simulator);
}

}  // namespace palpate::torture
