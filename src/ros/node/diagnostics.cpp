// SPDX-License-Identifier: GPL-3.0-or-later
#include "diagnostics.h"

#include <iomanip>
#include <sstream>

#include "palpate/base/error.h"
#include "palpate/tissue/skips.h"

namespace palpate::node {

using diagnostic_msgs::DiagnosticStatus;

namespace {

constexpr double kUntoldDelay = 0.004;  // [s]

std::string said(ToolState state) {
  switch (state) {
    case ToolState::kWaiting:
      return "no input has come yet for ";
    case ToolState::kStale:
      return "input stopped for ";
    default:
      return "lift out of the tissue: ";
  }
}

}  // namespace

Diagnostics::Diagnostics() {
  updater_.setHardwareID("none");
  updater_.add("simulation", this, &Diagnostics::simulation);
  updater_.add("input", this, &Diagnostics::input);
  updater_.add("haptic loop", this, &Diagnostics::haptic);
}

void Diagnostics::loading(const std::string& what) {
  loading_ = what;
  updater_.force_update();
}

void Diagnostics::running(const Inputs* inputs, HapticLoop* haptic,
                          const std::vector<std::string>& names) {
  inputs_ = inputs;
  names_ = names;
  haptic_ = haptic;
  haptic_since_ = Steady::now();
}

void Diagnostics::update(const ReportFrame& frame, const Statistics& statistics) {
  frame_ = frame;
  statistics_ = statistics;
  updater_.force_update();
}

void Diagnostics::simulation(Status& status) {
  if (!haptic_) {
    status.summary(DiagnosticStatus::OK, "loading: " + loading_);
    return;
  }
  const Statistics& s = statistics_;
  const sim::StepReport& report = frame_.report;
  const bool slow = s.rate_reached > 0.0 && s.rate_reached < kSlowShare * s.rate_wanted;
  status.summary(DiagnosticStatus::OK, toString(frame_.state));
  if (frame_.state == NodeState::kFault) {
    status.mergeSummary(DiagnosticStatus::ERROR,
                        "the solver does not converge: slow the instrument down, or ~reset");
  }
  if (slow && frame_.state == NodeState::kRunning) {
    status.mergeSummary(DiagnosticStatus::WARN, slowAdvice(s));
  }
  if (report.tools_inside > 0) {
    status.mergeSummary(DiagnosticStatus::WARN,
                        "a tool is inside an organ and feels nothing until it is clear of it: draw "
                        "it out, or ~reset with the tool outside");
  }
  if (report.recovery == static_cast<int>(tissue::Recovery::kFrozen)) {
    status.mergeSummary(DiagnosticStatus::WARN,
                        "an organ failed in cycle after cycle and is left as it is: draw the tools "
                        "out of it, or ~reset");
  }
  if (report.status == solver::SolveStatus::kInverted) {
    status.mergeSummary(DiagnosticStatus::WARN,
                        "elements are turned inside out: press less deep, or with a finer mesh");
  }
  if (!blas_warning_.empty()) status.mergeSummary(DiagnosticStatus::WARN, blas_warning_);
  status.add("state", toString(frame_.state));
  status.add("rate held [Hz]", s.rate_reached);
  status.add("rate possible [Hz]", s.verdict.rate_possible);
  status.add("rate wanted [Hz]", s.rate_wanted);
  status.add("simulated over real time", s.sim_speed);
  status.add("coarsening of adaptive meshes", s.coarsening);
  status.add("cycle p50 [ms]", s.cycle_p50);
  status.add("cycle p99 [ms]", s.cycle_p99);
  status.add("cycle max [ms]", s.cycle_max);
  status.add("input's age at its cycle p50 [ms]", s.input_age);
  status.add("costliest phase", std::string(toString(s.verdict.costliest)));
  status.add("its share of the slowest cycles", s.verdict.share);
  status.add("advice", advice::shortText(s.verdict));
  status.add("cycles", s.cycles);
  status.add("cycles not solved", s.unsolved);
  status.add("resets", s.resets);
  for (const std::string& note : notes_) status.add("note", note);
  for (const std::string& advice : mesh_advice_) status.add("mesh advice", advice);
  for (const tissue::Skip& skip : tissue::skips()) {
    if (skip.count) status.add(std::string("skipped ") + skip.counter, s.skipped.*skip.count);
  }
  status.add("skipped unwatched_pictures", s.unwatched_pictures);
  status.add("solver status", std::string(solver::toString(report.status)));
  status.add("recovery", report.recovery);
  status.add("contacts", report.contacts);
  status.add("imbalance [N]", report.imbalance);
  status.add("min jacobian", report.min_jacobian);
  status.add("tools inside", report.tools_inside);
}

void Diagnostics::input(Status& status) {
  if (!inputs_) {
    status.summary(DiagnosticStatus::OK, "loading");
    return;
  }
  status.summary(DiagnosticStatus::OK, "all instruments have fresh input");
  for (std::size_t i = 0; i < statistics_.tools.size(); ++i) {
    const ToolState state = statistics_.tools[i];
    if (state != ToolState::kLive) {
      status.mergeSummary(DiagnosticStatus::WARN,
                          said(state) + names_[i] + " (" + (*inputs_)[i]->source() + ")");
    }
    status.add("state of " + names_[i], toString(state));
  }
  for (std::size_t i = 0; i < inputs_->size(); ++i) {
    const Input& input = *(*inputs_)[i];
    const std::string problem = input.problem(), conflict = input.conflict();
    if (!problem.empty()) status.mergeSummary(DiagnosticStatus::WARN, problem);
    if (!conflict.empty()) {
      status.mergeSummary(DiagnosticStatus::ERROR,
                          names_[i] + " (" + input.source() + "): " + conflict);
    }
    status.add(input.source(), !conflict.empty() ? conflict : problem.empty() ? "ok" : problem);
  }
}

void Diagnostics::haptic(Status& status) {
  if (!haptic_) {
    status.summary(DiagnosticStatus::OK, "loading");
    return;
  }
  const HapticStatistics& s = haptic_->statistics();
  const Steady::time_point now = Steady::now();
  const long cycles = s.cycles;
  const double rate = static_cast<double>(cycles - haptic_cycles_) / inSeconds(now - haptic_since_);
  haptic_cycles_ = cycles;
  haptic_since_ = now;
  status.summary(DiagnosticStatus::OK, "real-time priority (SCHED_FIFO), memory locked");
  if (!s.realtime || !realtime_.sends) {
    status.summary(DiagnosticStatus::WARN,
                   "ordinary priority: SCHED_FIFO is not allowed here (see ulimit -r)");
  }
  if (!realtime_.memory) {
    status.mergeSummary(DiagnosticStatus::WARN, "memory is not locked (see ulimit -l)");
  }
  if (rate < kSlowShare * haptic_->rate()) {
    status.mergeSummary(DiagnosticStatus::WARN, "the force loop is late");
  }
  status.add("rate reached [Hz]", rate);
  status.add("rate wanted [Hz]", haptic_->rate());
  status.add("late cycles", s.late.load());
  const Percentiles period = haptic_->periods().percentiles();
  status.add("period as sent p50 [ms]", 1e3 * period.p50);
  status.add("period as sent p99 [ms]", 1e3 * period.p99);
  status.add("period as sent max [ms]", 1e3 * period.max);
  const Percentiles latency = haptic_->latencies().percentiles();
  status.add("stamp to wrench p50 [ms]", 1e3 * latency.p50);
  status.add("stamp to wrench p99 [ms]", 1e3 * latency.p99);
  if (latency.p50 > haptic_->delay() + kUntoldDelay) {
    std::ostringstream text;
    text << "poses are " << std::setprecision(2) << 1e3 * latency.p50
         << " ms old when they are answered: instruments[].device.delay must say so, with the way "
            "back";
    status.mergeSummary(DiagnosticStatus::WARN, text.str());
  }
  status.add("stiffness of the tissue [N/m]", s.tissue.load());
  status.add("stiffness as rendered [N/m]", s.rendered.load());
  status.add("peak force [N]", s.peak_force.load());
  status.add("energy out of a port, at most [mJ]", 1e3 * s.energy_out.load());
  status.add("energy taken back [mJ]", 1e3 * s.taken_back.load());
}

}  // namespace palpate::node
