// SPDX-License-Identifier: GPL-3.0-or-later
#include "recomputed_residual.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "at_surface.h"
#include "checks.h"
#include "draw_body.h"
#include "organ_cells.h"
#include "palpate/fem/inversion_guard.h"

namespace palpate::torture {
namespace {

constexpr double kRounding = 1e-9;  // of the forces that are summed
constexpr double kTwice = 2.0;      // what is unbalanced may be told by so much too small
// Of what presses: as much friction beyond Coulomb's law is taken back without another solution.
constexpr double kOfFriction = 1e-4;
// det F of quadratic tetrahedra where one of the small ones that the guard looks at may be flat.
constexpr double kMayBeFlat = 0.4;

bool isKnown(const TortureScene& scene) {
  const TortureOrgan& organ = scene.organs.front();
  return scene.organs.size() == 1 && organ.model == "fem" && organ.prony_g == 0.0 &&
         organ.stiffness_damping == 0.0 && organ.adapt == 0.0 &&
         scene.method != "linear_precomputed" &&
         (scene.integrator == "backward_euler" || scene.integrator == "static");
}

// Without inertia.
bool isStatic(const TortureScene& scene) {
  return scene.integrator == "static" || scene.method == "newton_bicgstab";
}

bool hasFibres(const TortureOrgan& organ) {
  return material::needsFibres(material::makeMaterial(organ.law, organ.constants));
}

// Fibres, sheets and their normal, of the direction that scenes are written with.
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
  remember(simulator);
}

void RecomputedResidual::remember(const sim::Simulator& simulator) {
  if (!knows()) return;
  x_ = simulator.shape(0).positions;
  v_ = simulator.shape(0).velocities;
}

// Of what may take explicit steps, those that have Newton's iterations.
bool RecomputedResidual::isOneStep(const Cycle& cycle) const {
  const sim::StepReport& report = cycle.result.report;
  const bool implicit =
      (scene_.method != "tled" && scene_.method != "auto") || report.newton_iterations > 0;
  return report.ok() && implicit && cycle.parts == 1 && report.time_steps == 1 &&
         report.sweep_stages == 1 && report.skipped.sleeping_organs == 0 &&
         report.recovery != static_cast<int>(tissue::Recovery::kPutBack);
}

// Elements as flat as that have an energy beside their law's.
bool RecomputedResidual::isGuarded(const Points& x) const {
  if (areLinearTets(rest_)) return leastVolumeRatio(rest_, x) < fem::InversionGuard::kLeast;
  return std::min(leastAtQuadraturePoints(rest_, x), leastAtCorners(rest_, x)) < kMayBeFlat;
}

// What acts at a point of the surface acts on the corners of its triangle; of a triangle whose
// corners were put where they are, what holds them is told as one force.
void RecomputedResidual::take(const sim::ContactPoint& point, const tissue::Shape& shape,
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

std::string RecomputedResidual::check(const Cycle& cycle) const {
  if (!knows() || !isOneStep(cycle)) return "";
  const tissue::Shape shape = cycle.simulator.shape(0);
  if (isGuarded(shape.positions)) return "";
  ++checked_;
  const TortureOrgan& organ = scene_.organs.front();
  const double h = cycle.result.report.step;
  Points forces = solid_->elasticForces(shape.positions);
  double sum = forces.colwise().norm().sum();
  forces += scene_.gravity * solid_->loaded().transpose();
  if (!isStatic(scene_)) {
    const Points v = (shape.positions - x_) / h;
    const Points inertia = ((v - v_) / h + organ.mass_damping * v) * solid_->masses().asDiagonal();
    forces -= inertia;
    sum += inertia.colwise().norm().sum();
  }
  for (const sim::ContactPoint& point : cycle.result.contacts) {
    sum += point.force_W.norm();
    if (point.organ == 0) take(point, shape, &forces);
  }
  for (Eigen::Index i = 0; i < forces.cols(); ++i) {
    if (organ.held && rest_.points(2, i) <= organ.heldTo()) forces.col(i).setZero();
  }
  const sim::StepReport& report = cycle.result.report;
  const double found = forces.norm();
  const double part = scene_.friction > 0.0 ? kOfFriction : kRounding;
  if (found <= kTwice * std::max(report.residual, report.tolerance) + part * sum) return "";
  return said("computed anew", found, "N are unbalanced,") +
         said(" told", report.residual, "N of") + said(" at most", report.tolerance, "N");
}

}  // namespace palpate::torture
