// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/io/case_solver.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "case_model.h"
#include "case_probes.h"
#include "palpate/solver/block_pcg.h"
#include "palpate/solver/cholmod_solver.h"
#include "palpate/solver/static_solver.h"

namespace palpate::io {
namespace {

constexpr int kMaxLinearIterations = 5000;

// What the supports exert on the nodes, 3 x n [N], at x; `potential` with all that acts.
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
  const solver::StaticReport report = solver::solveStatic(
      model->potential(), setLoad,
      {analysis.load_steps, analysis.tolerance, analysis.max_newton_iterations}, x, progress);
  result->load_steps = report.load_steps;
  result->newton_iterations = report.newton_iterations;
  result->residual = report.residual;
  return report.status;
}

std::unique_ptr<solver::LinearSolver> makeLinearSolver(const std::string& method) {
  if (method == "implicit_direct") return std::make_unique<solver::CholmodSolver>();
  return std::make_unique<solver::BlockPcg>(kMaxLinearIterations);
}

// Backward Euler: each step minimises the incremental potential.
class DynamicRun {
 public:
  DynamicRun(const DynamicAnalysis& analysis, CaseModel* model, const CaseProbes& probes)
      : analysis_(analysis),
        model_(*model),
        probes_(probes),
        inertia_(model->masses()),
        potential_(model->potential()),
        linear_(makeLinearSolver(analysis.method)),
        newton_(model->elasticity().makeMatrix()),
        v_(Points::Zero(3, model->mesh().numPoints())) {
    potential_.terms.push_back(&inertia_);
    model->setLoadFactor(1.0);
    load_norm_ = model->loadNorm();
    const double area = std::pow(model->elasticity().nodalVolumes().mean(), 2.0 / 3.0);
    force_floor_ = 0.01 * material::moduli(model->material()).mu * area;
  }

  solver::SolveStatus run(Points* x, SolveResult* result, ProbeHistory* history,
                          const std::function<void(double)>& progress) {
    const int steps = std::max(1, static_cast<int>(std::lround(analysis_.duration / analysis_.dt)));
    history->columns = probes_.columns();
    record(0.0, *x, Points::Zero(3, x->cols()), history);
    for (int k = 1; k <= steps; ++k) {
      const solver::SolveStatus status = step(k, static_cast<double>(k) / steps, x, result);
      if (status != solver::SolveStatus::kConverged) return status;
      record(k * analysis_.dt, *x, supportForce(potential_, *x), history);
      if (progress) progress(static_cast<double>(k) / steps);
    }
    return solver::SolveStatus::kConverged;
  }

  Points supportForceAt(const Points& x) const { return supportForce(potential_, x); }

 private:
  solver::SolveStatus step(int number, double s, Points* x, SolveResult* result) {
    const double h = analysis_.dt;
    const Points begin = *x;
    Points trial = begin;
    inertia_.beginStep(begin + h * v_, h);
    const Points move = (model_.heldPositions(s) - trial).array() * (1.0 - potential_.free.array());
    if (!move.isZero(0.0)) {
      const solver::SolveStatus moved = newton_.predict(potential_, move, linear_.get(), &trial);
      if (moved != solver::SolveStatus::kConverged) return moved;
    }
    solver::NewtonSettings settings;
    const double scale = std::max({load_norm_, last_reaction_, force_floor_});
    settings.tolerance = analysis_.tolerance * scale;
    settings.max_iterations = analysis_.max_newton_iterations;
    settings.linear_tolerance = analysis_.linear_tolerance;
    const solver::NewtonReport solved =
        newton_.minimize(potential_, settings, linear_.get(), &trial);
    result->newton_iterations += solved.iterations;
    result->residual = solved.residual / scale;
    if (solved.status != solver::SolveStatus::kConverged) return solved.status;
    result->load_steps = number;
    v_ = (trial - begin) / h;
    *x = trial;
    last_reaction_ = supportForce(potential_, *x).norm();
    return solved.status;
  }

  void record(double t, const Points& x, const Points& force, ProbeHistory* history) const {
    history->rows.push_back(CaseProbes::row(t, probes_.measure(model_, x, force)));
  }

  const DynamicAnalysis& analysis_;
  CaseModel& model_;
  const CaseProbes& probes_;
  solver::Inertia inertia_;
  solver::Potential potential_;
  std::unique_ptr<solver::LinearSolver> linear_;
  solver::Newton newton_;
  Points v_;
  double load_norm_, force_floor_, last_reaction_ = 0.0;  // [N]
};

void fillFields(const CaseModel& model, const Points& x, const Points& force,
                CaseOutcome* outcome) {
  const mesh::TetMesh& mesh = model.mesh();
  Eigen::MatrixXd stress(6, mesh.numTets()), jacobian(1, mesh.numTets());
  for (Eigen::Index e = 0; e < mesh.numTets(); ++e) {
    const Mat3 F = model.elasticity().deformationGradient(x, static_cast<int>(e));
    stress.col(e) = cauchyStress(model.material(), F);
    jacobian(0, e) = F.determinant();
  }
  outcome->mesh = mesh;
  outcome->point_data = {{"displacement", x - mesh.points}, {"reaction", force}};
  outcome->cell_data = {{"cauchy_stress", stress}, {"jacobian", jacobian}};
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
  } else {
    DynamicRun run(std::get<DynamicAnalysis>(problem.analysis), &model, probes);
    status = run.run(&x, &outcome.result, &outcome.history, progress);
    force = run.supportForceAt(x);
  }
  outcome.converged = status == solver::SolveStatus::kConverged;
  outcome.result.status = solver::toString(status);
  outcome.result.strain_energy = model.elasticity().energy(x);
  outcome.result.min_jacobian = model.elasticity().minJacobian(x);
  outcome.result.probes = probes.measure(model, x, force);
  fillFields(model, x, force, &outcome);
  return outcome;
}

}  // namespace palpate::io
