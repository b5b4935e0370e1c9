// SPDX-License-Identifier: GPL-3.0-or-later
#include "recomputed_residual.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "at_surface.h"
#include "checks.h"
#include "draw_body.h"
#include "organ_cells.h"

namespace palpate::torture {
namespace {

bool isKnown(const TortureScene& scene) {
  const TortureOrgan& organ = scene.organs.front();
  return scene.organs.size() == 1 && organ.model == "fem" && organ.prony_g == 0.0 &&
         organ.stiffness_damping == 0.0 && organ.adapt == 0.0 &&
         scene.method != "linear_precomputed";
}

// Without inertia.
bool isStatic(const TortureScene& scene) {
  return scene.integrator == "static" || scene.method == "newton_bicgstab";
}

mesh::TetMesh tetsOf(const mesh::CellMesh& cells) {
  mesh::TetMesh tets;
  tets.points = cells.points;
  tets.tets = cells.cells.topRows<4>();
  if (areQuadraticTets(cells)) tets.midnodes = cells.cells.bottomRows<6>();
  return tets;
}

bool hasFibres(const TortureOrgan& organ) {
  return material::needsFibres(material::makeMaterial(organ.law, organ.constants));
}

// Fibre, sheet and normal, as in written scenes.
Mat3 fibreFrame() {
  Mat3 frame;
  frame.col(0) = Vec3(1.0, 0.3, 0.1).normalized();
  const Vec3 up = Vec3::UnitZ();
  frame.col(1) = (up - up.dot(frame.col(0)) * frame.col(0)).normalized();
  frame.col(2) = frame.col(0).cross(frame.col(1));
  return frame;
}

}  // namespace

RecomputedResidual::RecomputedResidual(const TortureScene& scene, const sim::Simulator& simulator)
    : scene_(scene) {
  if (!isKnown(scene)) return;
  rest_ = simulator.cells(0);
  if (!areLinearTets(rest_) && !areQuadraticTets(rest_)) return;
  const TortureOrgan& organ = scene.organs.front();
  std::vector<material::Material> laws{material::makeMaterial(organ.law, organ.constants)};
  if (organ.contrast > 1.0) {
    laws.push_back(material::makeMaterial(organ.law, stiffened(organ.constants, organ.contrast)));
  }
  const Mat3 frame = hasFibres(organ) ? fibreFrame() : Mat3(Mat3::Identity());
  solid_ = std::make_unique<TextbookSolid>(rest_, organ.element, laws, organ.density, frame);
  guard_ = std::make_unique<fem::InversionGuard>(tetsOf(rest_), 1.0);
  remember(simulator);
}

void RecomputedResidual::remember(const sim::Simulator& simulator) {
  if (!knows()) return;
  x_before_ = x_;
  v_before_ = v_;
  x_ = simulator.surfaceState(0).positions;
  v_ = simulator.surfaceState(0).velocities;
}

// Whether the cycle was a single implicit step, which Newton iterations show for mixed methods.
bool RecomputedResidual::isOneStep(const Cycle& cycle) const {
  const sim::StepReport& report = cycle.result.report;
  const bool implicit =
      (scene_.method != "tled" && scene_.method != "auto") || report.newton_iterations > 0;
  return report.ok() && implicit && cycle.parts == 1 && report.time_steps == 1 &&
         report.sweep_stages > 0 && report.skipped.sleeping_organs == 0 &&
         report.recovery != static_cast<int>(tissue::Recovery::kPutBack);
}

// Distributes a force on a surface point to the corners of its triangle. Prescribed corners are
// reported with the total reaction as one force.
void RecomputedResidual::take(const sim::ContactPoint& point, const tissue::SurfaceState& shape,
                              Points* forces) const {
  const OnSurface at = nearestOnSurface(shape, point.p_W);
  const bool put = scene_.method == "newton_bicgstab";
  for (int k = 0; k < 3; ++k) {
    if (put) {
      forces->col(at.corners[k]).setZero();
    } else {
      forces->col(at.corners[k]) -= at.weights[k] * point.force_W;
    }
  }
}

// Norm of the residual of `forces` at free nodes [N], with inertia and damping of v = (x -
// x_hat)/k, a = (v - v_hat)/k.
double RecomputedResidual::unbalanced(const Cycle& cycle, const Points& forces, double k,
                                      const Points& x_hat, const Points& v_hat) const {
  const TortureOrgan& organ = scene_.organs.front();
  const tissue::SurfaceState shape = cycle.simulator.surfaceState(0);
  Points left = forces;
  if (!isStatic(scene_)) {
    const Points v = (shape.positions - x_hat) / k;
    left -= ((v - v_hat) / k + organ.mass_damping * v) * solid_->masses().asDiagonal();
  }
  for (const sim::ContactPoint& point : cycle.result.contacts) {
    if (point.organ == 0) take(point, shape, &left);
  }
  for (Eigen::Index i = 0; i < left.cols(); ++i) {
    if (organ.held && rest_.points(2, i) <= organ.heldTo()) left.col(i).setZero();
  }
  return left.norm();
}

std::string RecomputedResidual::check(const Cycle& cycle) {
  if (!knows() || !isOneStep(cycle)) return "";
  const Points& x = cycle.simulator.positions(0);
  // Elements with det F below the guard's limit have its energy, too.
  if (guard_->least(x) < fem::InversionGuard::kLeast) return "";
  ++checked_;
  const sim::StepReport& report = cycle.result.report;
  Points forces = solid_->elasticForces(x);
  double sum = forces.colwise().norm().sum();
  forces += scene_.gravity * solid_->loaded().transpose();
  double found = unbalanced(cycle, forces, report.step, x_, v_);
  if (scene_.integrator == "bdf2" && x_before_.cols() == x.cols()) {
    found = std::min(found, unbalanced(cycle, forces, 2.0 / 3.0 * report.step,
                                       (4.0 * x_ - x_before_) / 3.0, (4.0 * v_ - v_before_) / 3.0));
  }
  // Cancelling forces determine the rounding error.
  for (const sim::ContactPoint& point : cycle.result.contacts) sum += point.force_W.norm();
  if (!isStatic(scene_)) {
    const double fastest = ((x - x_) / report.step - v_).norm() / report.step;
    sum += solid_->masses().maxCoeff() * fastest;
  }
  const double part = scene_.friction > 0.0 ? kOfFriction : kRoundingOfForces;
  if (found <= kTwice * std::max(report.residual, report.tolerance) + part * sum) return "";
  return said("computed anew", found, "N are unbalanced,") +
         said(" told", report.residual, "N of") + said(" at most", report.tolerance, "N");
}

}  // namespace palpate::torture
