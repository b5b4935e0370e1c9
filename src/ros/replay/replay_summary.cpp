// SPDX-License-Identifier: GPL-3.0-or-later
#include "replay_summary.h"

#include <algorithm>
#include <iomanip>

#include "palpate/base/percentiles.h"

namespace palpate::node {

ReplaySummary::ReplaySummary(const scene::Scene& scene) : peak_force_(scene.instruments.size()) {
  for (const scene::InstrumentConfig& instrument : scene.instruments) {
    names_.push_back(instrument.name);
  }
}

void ReplaySummary::add(const sim::StepResult& result, double cycle_ms) {
  for (std::size_t i = 0; i < peak_force_.size(); ++i) {
    peak_force_[i] = std::max(peak_force_[i], result.instruments[i].spatial.force.norm());
  }
  mesh_error_ = std::max(mesh_error_, result.report.mesh_error);
  contacts_ = std::max(contacts_, result.report.contacts);
  unsolved_ += result.report.ok() ? 0 : 1;
  skipped_ += result.report.skipped.total();
  cycle_ms_.push_back(cycle_ms);
}

void ReplaySummary::print(std::ostream& out, double simulated, double wall, long dropped) const {
  const auto row = [&](const std::string& name) -> std::ostream& {
    return out << std::left << std::setw(28) << name << std::right;
  };
  out << std::fixed << std::setprecision(3);
  for (std::size_t i = 0; i < names_.size(); ++i) {
    row("peak force of " + names_[i] + " [N]") << peak_force_[i] << '\n';
  }
  row("mesh error, largest [N]") << mesh_error_ << '\n';
  row("contacts, most") << contacts_ << '\n';
  const Percentiles p = percentiles(cycle_ms_);
  row("cycle p50/p99/max [ms]") << p.p50 << " / " << p.p99 << " / " << p.max << '\n';
  row("cycles") << cycle_ms_.size() << '\n';
  row("cycles not solved") << unsolved_ << '\n';
  row("work skipped") << skipped_ << '\n';
  row("messages dropped") << dropped << '\n';
  row("simulated / wall time [s]") << simulated << " / " << wall << '\n';
}

}  // namespace palpate::node
