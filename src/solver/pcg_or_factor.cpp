// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/pcg_or_factor.h"

#include <algorithm>

#include "palpate/base/state_bytes.h"

namespace palpate::solver {
namespace {

// Least cost of a factor, in iterations.
constexpr double kFewIterations = 50.0;
// Failed solves before factorising; a single one may be accidental.
constexpr double kFewSolves = 2.0;
// Decay of the failed work per cycle [-].
constexpr double kKept = 0.5;
constexpr int kMostCycles = 64;

}  // namespace

void PcgOrFactor::onlyChanged(const std::vector<int>& slots) {
  if (taken_ && !factorises_) pcg_.onlyChanged(slots);
}

void PcgOrFactor::beginCycle(double dt) {
  pcg_.beginCycle(dt);
  factor_.beginCycle(dt);
  if (!factorises_) cycles_next_ = 1;
  factorises_ = cycles_left_ > 0;
  if (factorises_) --cycles_left_;
  in_vain_ *= kKept;
  solves_in_vain_ *= kKept;
}

void PcgOrFactor::restart() {
  pcg_.restart();
  factor_.restart();
  cycles_left_ = 0;
  cycles_next_ = 1;
  factorises_ = false;
  in_vain_ = solves_in_vain_ = 0.0;
}

void PcgOrFactor::save(StateWriter* out) const {
  out->put(cycles_left_);
  out->put(cycles_next_);
  out->put(factorises_);
  out->put(in_vain_);
  out->put(solves_in_vain_);
}

void PcgOrFactor::restore(StateReader* in) {
  in->get(&cycles_left_);
  in->get(&cycles_next_);
  in->get(&factorises_);
  in->get(&in_vain_);
  in->get(&solves_in_vain_);
  factor_.restart();
}

bool PcgOrFactor::factorPays(const fem::Stiffness& A) {
  return solves_in_vain_ >= kFewSolves && in_vain_ >= kFewIterations &&
         in_vain_ * BlockPcg::iterationSeconds(A) >= factor_.seconds(A);
}

LinearReport PcgOrFactor::solve(const fem::Stiffness& A, const Points& b, double relative_tolerance,
                                Points* x) {
  taken_ = !factorises_;
  factor_.setInterrupt(interrupt());
  if (factorises_) return factor_.solve(A, b, relative_tolerance, x);
  pcg_.setInterrupt(interrupt());
  const LinearReport by_iterations = pcg_.solve(A, b, relative_tolerance, x);
  if (!by_iterations.in_vain) return by_iterations;
  in_vain_ += by_iterations.iterations;
  ++solves_in_vain_;
  if (!factorPays(A) || isInterrupted(interrupt())) return by_iterations;
  factorises_ = true;
  cycles_left_ = cycles_next_;
  cycles_next_ = std::min(kMostCycles, 2 * cycles_next_);
  const LinearReport report = factor_.solve(A, b, relative_tolerance, x);
  return {report.status, by_iterations.iterations + report.iterations};
}

}  // namespace palpate::solver
