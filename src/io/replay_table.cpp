// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/io/replay_table.h"

#include <cstdint>

namespace palpate::io {
namespace {

// As text, since a double cannot hold 64-bit integers.
std::string hexText(std::uint64_t value) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text = "0x0000000000000000";
  for (std::size_t k = text.size() - 1; k > 1; --k, value >>= 4) text[k] = kDigits[value & 15];
  return text;
}

}  // namespace

std::vector<std::string> replayColumns(const scene::Scene& scene) {
  std::vector<std::string> names{"t"};
  for (const scene::InstrumentConfig& instrument : scene.instruments) {
    const std::string prefix = scene.instruments.size() > 1 ? instrument.name + "/" : "";
    for (const char* part : {"fx", "fy", "fz", "tx", "ty", "tz", "contacts", "max_penetration"}) {
      names.push_back(prefix + part);
    }
  }
  for (const char* name :
       {"newton_iterations", "cg_iterations", "residual", "min_jacobian", "kinetic_energy",
        "elastic_energy", "status", "recovery", "step_ms", "skipped", "mesh_error", "nodes",
        "mesh_changes", "walk_steps", "tree_queries", "state_hash"}) {
    names.emplace_back(name);
  }
  return names;
}

void writeReplayRow(double t, const sim::StepResult& result, double step_ms, CsvWriter* csv) {
  *csv << t;
  for (const sim::InstrumentResult& tool : result.instruments) {
    for (int c = 0; c < 3; ++c) *csv << tool.spatial.force[c];
    for (int c = 0; c < 3; ++c) *csv << tool.spatial.torque[c];
    *csv << tool.contacts << tool.max_penetration;
  }
  const sim::StepReport& r = result.report;
  *csv << r.newton_iterations << r.linear_iterations << r.residual << r.min_jacobian
       << r.kinetic_energy << r.elastic_energy << std::string(solver::toString(r.status))
       << r.recovery << step_ms << static_cast<int>(r.skipped.total()) << r.mesh_error << r.nodes
       << r.mesh_changes << r.walk_steps << r.tree_queries << hexText(r.state_hash);
  csv->endRow();
}

}  // namespace palpate::io
