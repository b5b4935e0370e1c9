// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/io/result_json.h"

#include "palpate/base/atomic_file.h"
#include "palpate/io/json.h"

namespace palpate::io {

std::string resultJson(const analysis::SolveResult& result) {
  JsonMembers seconds, energies, probes(",\n    ");
  for (const auto& [region, energy] : result.energy_by_region) energies.add(region, json(energy));
  for (const auto& [part, time] : result.seconds) seconds.add(part, json(time));
  for (const analysis::ProbeResult& p : result.probes) {
    JsonMembers probe;
    probe.add("displacement", p.displacement);
    probe.add("cauchy_stress", p.cauchy_stress);
    probe.add("von_mises", p.von_mises);
    probe.add("principal_stretches", p.principal_stretches);
    probe.add("force", p.force);
    probe.add("moment", p.moment);
    probes.add(p.name, probe.object());
  }
  JsonMembers all(",\n  ");
  all.add("status", jsonText(result.status));
  all.add("load_steps", std::to_string(result.load_steps));
  if (result.load_factor < 1.0) all.add("load_factor", json(result.load_factor));
  if (result.rejected_steps > 0) {
    all.add("rejected_steps", std::to_string(result.rejected_steps));
  }
  all.add("newton_iterations", std::to_string(result.newton_iterations));
  all.add("residual", json(result.residual));
  all.add("strain_energy", json(result.strain_energy));
  if (!result.energy_by_region.empty()) {
    all.add("strain_energy_by_region", energies.object());
  }
  all.add("min_jacobian", json(result.min_jacobian));
  all.add("seconds", seconds.object());
  all.add("probes", result.probes.empty() ? "{}" : "{\n    " + probes.text() + "\n  }");
  return "{\n  " + all.text() + "\n}\n";
}

void writeResultJson(const std::string& file, const analysis::SolveResult& result) {
  writeFileAtomically(file, resultJson(result));
}

}  // namespace palpate::io
