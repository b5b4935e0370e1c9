// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/analysis/case_solver.h"

#include "case_dynamics.h"
#include "case_model.h"
#include "case_probes.h"
#include "palpate/material/measures.h"
#include "palpate/solver/static_solver.h"

namespace palpate::analysis {
namespace {

// Forces of the supports on the nodes at x, 3 x n [N]; `potential` contains all other forces.
Points supportForce(const solver::Potential& potential, const Points& x) {
  Points g;
  potential.gradient(x, &g);
  return g.array() * (1.0 - potential.free.array());
}

solver::SolveStatus solveStatically(const StaticAnalysis& analysis, CaseModel* model, Points* x,
                                    SolveResult* result,
                                    const std::function<void(double)>& progress) {
  const auto setLoad = [&](double s) {
    model->setLoadFactor(s);
    return model->heldPositions(s);
  };
  const solver::StaticReport report =
      solver::solveStatic(model->potential(), setLoad, analysis, x, progress);
  result->load_steps = report.load_steps;
  result->newton_iterations = report.newton_iterations;
  result->residual = report.residual;
  result->load_factor = report.load_factor;
  return report.status;
}

// Regions with their own material are solids of the composition; the rest is the body.
std::vector<std::pair<std::string, double>> energyByRegion(const Case& problem,
                                                           const CaseModel& model,
                                                           const Points& x) {
  std::vector<std::string> names{"body"};
  for (const scene::RegionConfig& region : problem.regions) {
    if (region.material) names.push_back(region.name);
  }
  const Eigen::VectorXd energies = model.elasticity()->energyBySolid(x);
  std::vector<std::pair<std::string, double>> by_region;
  for (std::size_t i = 0; i < names.size(); ++i) {
    by_region.emplace_back(names[i], energies[static_cast<Eigen::Index>(i)]);
  }
  return by_region;
}

// Stress and stretch are those at the centroid of each tetrahedron.
void fillFields(const CaseModel& model, const Points& x, const Points& force,
                CaseOutcome* outcome) {
  const mesh::TetMesh& mesh = model.mesh();
  Eigen::MatrixXd stress(6, mesh.numTets()), stretches(3, mesh.numTets());
  Eigen::MatrixXd von_mises(1, mesh.numTets()), jacobian(1, mesh.numTets());
  std::vector<mesh::Location> middles;
  middles.reserve(static_cast<std::size_t>(mesh.numTets()));
  for (int e = 0; e < mesh.numTets(); ++e) {
    middles.push_back({e, Eigen::Vector4d::Constant(0.25)});
  }
  const std::vector<fem::PointState> states = model.elasticity()->states(x, middles);
  for (Eigen::Index e = 0; e < mesh.numTets(); ++e) {
    const fem::PointState& state = states[static_cast<std::size_t>(e)];
    stress.col(e) = material::components(state.cauchy_stress);
    stretches.col(e) = material::stretchesOf(state.F);
    von_mises(0, e) = material::vonMises(state.cauchy_stress);
    jacobian(0, e) = state.F.determinant();
  }
  outcome->mesh = mesh;
  outcome->point_data = {{"displacement", x - mesh.points}, {"reaction", force}};
  outcome->cell_data = {{"cauchy_stress", stress},
                        {"von_mises", von_mises},
                        {"principal_stretches", stretches},
                        {"jacobian", jacobian}};
}

}  // namespace

CaseOutcome solveCase(const Case& problem, int threads,
                      const std::function<void(double)>& progress) {
  ThreadPool pool(threads);
  CaseModel model(problem, &pool);
  const CaseProbes probes(problem, model);
  CaseOutcome outcome;
  Points x = model.mesh().points, force;
  solver::SolveStatus status;
  if (const auto* analysis = std::get_if<StaticAnalysis>(&problem.analysis)) {
    status = solveStatically(*analysis, &model, &x, &outcome.result, progress);
    force = supportForce(model.potential(), x);
    outcome.result.strain_energy = model.elasticity()->energy(x);
  } else {
    CaseDynamics dynamics(problem, &model, probes, &pool);
    outcome.notes = dynamics.body().notes();
    status = dynamics.run(&outcome.result, &outcome.history, progress);
    x = dynamics.body().positions();
    force = dynamics.body().supportForces();
    outcome.result.strain_energy = dynamics.body().elasticEnergy();
  }
  outcome.result.min_jacobian = model.elasticity()->minJacobian(x);
  status = solver::judged(status, outcome.result.min_jacobian);
  outcome.converged = status == solver::SolveStatus::kConverged;
  outcome.result.status = solver::toString(status);
  if (!problem.regions.empty()) outcome.result.energy_by_region = energyByRegion(problem, model, x);
  outcome.result.probes = probes.measure(model, x, force);
  fillFields(model, x, force, &outcome);
  return outcome;
}

}  // namespace palpate::analysis
