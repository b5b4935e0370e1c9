// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>

#include "method_choice.h"
#include "method_refusal.h"
#include "palpate/solver/block_pcg.h"
#include "palpate/solver/cholmod_solver.h"
#include "palpate/solver/factor_counts.h"
#include "tissue/body/rest_matrix.h"
#include "tissue/methods/explicit/critical_step.h"

namespace palpate::tissue {
namespace {

// Radius of the probe's load, over the body's size [-].
constexpr double kProbe = 0.1;

// Load of a probe, 3 x n [N]: on free surface nodes around the one farthest from the supports'
// middle, towards the middle of the body.
Points probe(const FemBody& body) {
  const Points& X = body.mesh.points;
  const Vec3 middle = X.rowwise().mean();
  Vec3 held = Vec3::Zero();
  int num_held = 0;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    if (!body.free.col(i).isZero()) continue;
    held += X.col(i);
    ++num_held;
  }
  held = num_held > 0 ? Vec3(held / num_held) : middle;
  int place = -1;
  double farthest = -1.0;
  for (const int node : body.triangles.reshaped()) {
    const double distance = (X.col(node) - held).norm();
    if (body.free.col(node).isZero() || distance <= farthest) continue;
    farthest = distance;
    place = node;
  }
  Points push = Points::Zero(3, X.cols());
  if (place < 0) return push;
  for (const int node : body.triangles.reshaped()) {
    if ((X.col(node) - X.col(place)).norm() > kProbe * body.size) continue;
    push.col(node) = middle - X.col(place);
  }
  return push.cwiseProduct(body.free);
}

int trialIterations(FemBody* body, const fem::Stiffness& A) {
  const int most = body->settings.max_linear_iterations;
  solver::BlockPcg pcg(most, body->pool, bestIsa(), body->mesh.points);
  pcg.takePattern(A);
  if (pcg.learnsFromRest(body->settings.lasting)) pcg.learnFromRest(A);
  Points x;
  const solver::LinearReport report =
      pcg.solve(A, probe(*body), body->settings.linear_tolerance, &x);
  return report.status == solver::SolveStatus::kConverged ? report.iterations : most;
}

}  // namespace

CycleCounts countCycle(FemBody* body) {
  const FemSettings& settings = body->settings;
  CycleCounts counts;
  counts.poisson_ratio = body->largest_poisson_ratio;
  fem::Stiffness A = body->elasticity->makeMatrix();
  assembleAtRest(body, &A);
  // A sheet counts its triangles, with about as many springs as elements have edges.
  const Eigen::Index cells =
      body->mesh.numTets() > 0 ? body->mesh.numTets() : body->triangles.cols();
  counts.tets = {static_cast<double>(cells), body->mesh.quadratic(), A.hasVolume()};
  counts.blocks = A.blocks().numBlocks();
  if (A.hasVolume()) counts.volume_entries = static_cast<double>(A.volume().rows.cols());
  counts.linear_iterations = trialIterations(body, A);
  counts.direct = solver::CholmodSolver().seconds(A);
  const solver::FactorCounts factor = solver::countFactor(A);
  counts.factor_flops = factor.flops;
  counts.factor_nonzeros = factor.nonzeros;
  counts.explicit_accepts = methodRefusal(methodFacts("tled"), *body).empty();
  counts.mass_damping = settings.mass_damping > 0.0;
  CriticalStep critical(
      body->elasticity.get(), body->free,
      body->surroundings.largestSquare(body->mesh.points, body->elasticity->masses()));
  critical.begin(body->mesh.points);
  counts.sub_steps =
      std::max(1.0, std::ceil(settings.step / (CriticalStep::kSafety * critical.seconds())));
  body->elasticity->relax(body->mesh.points);
  return counts;
}

}  // namespace palpate::tissue
