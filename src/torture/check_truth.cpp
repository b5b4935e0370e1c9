// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <vector>

#include "checks.h"
#include "independent_forces.h"
#include "organ_cells.h"
#include "palpate/fem/inversion_guard.h"

namespace palpate::torture {
namespace {

constexpr double kRounding = 1e-9;  // of the forces that are summed
constexpr double kTwice = 2.0;      // what is unbalanced may be told by so much too small
// Of what presses: as much friction beyond Coulomb's law is taken back without another solution.
constexpr double kOfFriction = 1e-4;

// The wrench of a cycle that is told is the sum of what touches; in a scene with bone too.
std::string wrongWrench(const sim::StepResult& result) {
  for (std::size_t i = 0; i < result.instruments.size(); ++i) {
    const sim::InstrumentResult& tool = result.instruments[i];
    if (!tool.live) continue;
    Wrench sum;
    double parts = 0.0;
    for (const sim::ContactPoint& point : result.contacts) {
      if (point.instrument != static_cast<int>(i)) continue;
      const Vec3 arm = point.p_W - tool.X_WC.translation();
      sum += Wrench{point.force_W, arm.cross(point.force_W)};
      parts += point.force_W.norm() * (1.0 + arm.norm());
    }
    const double off =
        std::max((sum.force - tool.solved.force).norm(), (sum.torque - tool.solved.torque).norm());
    if (off > kRounding * parts + 1e-12)
      return said("wrench is off the sum of contacts by", off, "N");
  }
  return "";
}

// All forces of a cycle that is converged cancel, but for what is left at its points: their sum is
// at most that at one of them by the root of their number.
std::string wrongSum(const Cycle& cycle, bool friction) {
  const sim::StepReport& report = cycle.result.report;
  double forces = 0.0;
  for (const sim::ContactPoint& point : cycle.result.contacts) forces += point.force_W.norm();
  const double left = std::max(report.residual, report.tolerance);
  const double bound = kTwice * std::sqrt(static_cast<double>(report.nodes)) * left;
  const double part = friction ? kOfFriction : kRounding;
  if (report.imbalance <= bound + part * forces + 1e-12) return "";
  return said("forces add up to", report.imbalance, "N,") + said(" told", left, "N at the points") +
         " after " + std::to_string(report.sweep_stages) + " stages";
}

// Of one organ of linear tetrahedra by one step of backward Euler, whose every force is known here.
bool isKnown(const TortureScene& scene) {
  const TortureOrgan& organ = scene.organs.front();
  const bool implicit = scene.method.rfind("implicit", 0) == 0 || scene.method == "lbfgs";
  return scene.organs.size() == 1 && organ.model == "fem" && organ.element == "tet4" && implicit &&
         scene.integrator == "backward_euler" && organ.prony_g == 0.0 &&
         organ.stiffness_damping == 0.0 && organ.adapt == 0.0 &&
         !material::needsFibres(material::makeMaterial(organ.law, organ.constants));
}

class Truth : public Criterion {
 public:
  Truth(const TortureScene& scene, const sim::Simulator& simulator)
      : scene_(scene), known_(isKnown(scene)) {
    if (!known_) return;
    const TortureOrgan& organ = scene.organs.front();
    soft_ =
        std::make_unique<material::Material>(material::makeMaterial(organ.law, organ.constants));
    remember(simulator);
    rest_ = simulator.cells(0);
    masses_ = lumpedMasses(rest_, organ.density);
    const auto count = static_cast<std::size_t>(rest_.numCells());
    laws_.assign(count, soft_.get());
    known_ = organ.contrast == 1.0 && areLinearTets(rest_);
  }

  std::string check(const Cycle& cycle) override {
    const sim::StepReport& report = cycle.result.report;
    std::string wrong = wrongWrench(cycle.result);
    if (wrong.empty() && report.ok() && report.residual > report.tolerance) {
      wrong =
          said("converged with a residual of", report.residual / report.tolerance, "tolerances");
    }
    if (wrong.empty() && report.ok()) wrong = wrongSum(cycle, scene_.friction > 0.0);
    if (!known_) return wrong;
    const bool plain = report.ok() && cycle.parts == 1 && report.time_steps == 1 &&
                       report.sweep_stages == 1 && report.skipped.sleeping_organs == 0 &&
                       !isGuarded(cycle.simulator);
    if (wrong.empty() && plain) wrong = wrongResidual(cycle);
    remember(cycle.simulator);
    return wrong;
  }

  void placed(const sim::Simulator& simulator) override {
    if (known_) remember(simulator);
  }

 private:
  void remember(const sim::Simulator& simulator) {
    x_ = simulator.shape(0).positions;
    v_ = simulator.shape(0).velocities;
  }

  // Elements as flat as that have an energy beside their law's.
  bool isGuarded(const sim::Simulator& simulator) const {
    return leastVolumeRatio(rest_, simulator.positions(0)) < fem::InversionGuard::kLeast;
  }

  std::string wrongResidual(const Cycle& cycle) const {
    const tissue::Shape shape = cycle.simulator.shape(0);
    const TortureOrgan& organ = scene_.organs.front();
    const double h = cycle.result.report.step;
    Points forces = elasticForces(rest_, shape.positions, laws_);
    double sum = forces.colwise().norm().sum();
    for (Eigen::Index i = 0; i < forces.cols(); ++i) {
      const Vec3 v = (shape.positions.col(i) - x_.col(i)) / h;
      const Vec3 inertia = masses_[i] * ((v - v_.col(i)) / h + organ.mass_damping * v);
      forces.col(i) += masses_[i] * scene_.gravity - inertia;
      sum += inertia.norm();
    }
    for (const sim::ContactPoint& point : cycle.result.contacts) {
      if (point.organ == 0) addAtSurface(shape, point, &forces);
      sum += point.force_W.norm();
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

  const TortureScene& scene_;
  bool known_;
  std::unique_ptr<material::Material> soft_;
  std::vector<const material::Material*> laws_;
  mesh::CellMesh rest_;
  Eigen::VectorXd masses_;
  Points x_, v_;
};

}  // namespace

std::unique_ptr<Criterion> checkTruth(const TortureScene& scene, const sim::Simulator& simulator) {
  return std::make_unique<Truth>(scene, simulator);
}

}  // namespace palpate::torture
