// SPDX-License-Identifier: GPL-3.0-or-later
#include "case_probes.h"

#include "palpate/material/measures.h"

#include "palpate/base/error.h"

namespace palpate::analysis {

CaseProbes::CaseProbes(const Case& problem, const CaseModel& model) {
  for (std::size_t i = 0; i < problem.probes.size(); ++i) {
    Placed placed;
    placed.probe = problem.probes[i];
    const std::string key = "probes[" + std::to_string(i) + "]";
    if (placed.probe.point) {
      placed.at = mesh::locate(model.mesh(), *placed.probe.point);
      if (!placed.at) {
        throw InputError(problem.file, key + ".point", "", "must lie inside the mesh");
      }
    } else {
      placed.nodes = mesh::selectPoints(model.mesh().points, *placed.probe.select);
      if (placed.nodes.empty()) {
        throw InputError(problem.file, key + ".select", "", "must select at least one node");
      }
    }
    placed_.push_back(std::move(placed));
  }
}

std::vector<ProbeResult> CaseProbes::measure(const CaseModel& model, const Points& x,
                                             const Points& support_force) const {
  std::vector<ProbeResult> results;
  for (const Placed& placed : placed_) {
    ProbeResult result;
    result.name = placed.probe.name;
    if (placed.at) {
      result.displacement = mesh::interpolate(model.mesh(), *placed.at, x - model.mesh().points);
      const fem::PointState state = model.elasticity()->states(x, {*placed.at}).front();
      result.cauchy_stress = material::components(state.cauchy_stress);
      result.von_mises = material::vonMises(state.cauchy_stress);
      result.principal_stretches = material::stretchesOf(state.F);
    } else {
      Wrench sum;
      for (int i : placed.nodes) {
        const Vec3 f = support_force.col(i);
        sum += Wrench{f, Vec3(x.col(i)).cross(f)};
      }
      result.force = sum.force;
      result.moment = sum.torque;
    }
    results.push_back(std::move(result));
  }
  return results;
}

std::vector<std::string> CaseProbes::columns() const {
  std::vector<std::string> columns{"t"};
  for (const Placed& placed : placed_) {
    const std::vector<std::string> point = {"ux",  "uy",  "uz",        "sxx", "syy", "szz", "sxy",
                                            "syz", "szx", "von_mises", "l1",  "l2",  "l3"};
    const std::vector<std::string> region = {"fx", "fy", "fz", "mx", "my", "mz"};
    for (const std::string& part : placed.at ? point : region) {
      columns.push_back(placed.probe.name + "." + part);
    }
  }
  return columns;
}

std::vector<double> CaseProbes::row(double t, const std::vector<ProbeResult>& results) {
  std::vector<double> row{t};
  const auto append = [&](const auto& v) {
    row.insert(row.end(), v->data(), v->data() + v->size());
  };
  for (const ProbeResult& r : results) {
    if (r.displacement) append(r.displacement);
    if (r.cauchy_stress) append(r.cauchy_stress);
    if (r.von_mises) row.push_back(*r.von_mises);
    if (r.principal_stretches) append(r.principal_stretches);
    if (r.force) append(r.force);
    if (r.moment) append(r.moment);
  }
  return row;
}

}  // namespace palpate::analysis
