// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/fem_tissue.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "palpate/contact/contact_potential.h"
#include "palpate/fem/loads.h"
#include "palpate/solver/block_pcg.h"
#include "palpate/solver/integrator.h"
#include "palpate/solver/static_solver.h"
#include "tool_sweep.h"

namespace palpate::tissue {
namespace {

// A body at rest moves less than this part of its size in a cycle.
constexpr double kRestMotion = 1e-6;
// A viscous one may creep far in many cycles.
constexpr double kRestMotionViscous = 1e-9;
// Shorter time steps that are tried where a cycle fails.
constexpr int kMaxTimeSteps = 8;
// Stages before the last one need not be solved as well.
constexpr double kStageTolerance = 100.0;
constexpr int kStageIterations = 4;
// Candidates for contact are searched this many times before a cycle is given up.
constexpr int kMaxSearches = 4;

class FemTissue final : public TissueModel {
 public:
  FemTissue(const mesh::TetMesh& mesh, const fem::Composition& composition,
            const fem::FreeMask& free, const FemSettings& settings, ThreadPool* pool)
      : settings_(settings),
        mesh_(mesh),
        size_((mesh.points.rowwise().maxCoeff() - mesh.points.rowwise().minCoeff()).norm()),
        triangles_(mesh::trianglesOf(mesh::boundaryFaces(mesh))),
        elasticity_(fem::makeElasticity(settings.element, mesh, composition, pool)),
        integrator_(settings.integrator, elasticity_->masses(),
                    {settings.mass_damping, settings.stiffness_damping}),
        gravity_(settings.gravity * elasticity_->loadWeights().transpose()),
        contact_(contact::sampleSurface(mesh.points, triangles_, settings.sample_spacing),
                 settings.penalty),
        sweep_(&contact_, size_),
        linear_(settings.max_linear_iterations),
        newton_(elasticity_->makeMatrix()) {
    potential_ = {elasticity_.get(), {&gravity_, &contact_}, free};
    integrator_.addTerms(&potential_);
    // Force of a small strain on one element: keeps the tolerance above zero in a scene at rest.
    const double element_area =
        std::pow(elasticity_->volume() / static_cast<double>(mesh.numPoints()), 2.0 / 3.0);
    force_floor_ = 0.1 * composition.softestShearModulus() * element_area;
    rest_motion_ = (elasticity_->viscous() ? kRestMotionViscous : kRestMotion) * size_;
    settleUnderGravity();
    FemTissue::reset();
  }

  const mesh::TetMesh& restMesh() const override { return mesh_; }
  const Points& positions() const override { return x_; }
  const Points& velocities() const override { return integrator_.velocities(); }
  const Eigen::Matrix3Xi& surfaceTriangles() const override { return triangles_; }

  void reset() override { restore(settled_, Points::Zero(3, settled_.cols())); }

  void restore(const Points& positions, const Points& velocities) override {
    x_ = positions;
    integrator_.start(positions, velocities);
    elasticity_->relax(positions);
    if (integrator_.needsElasticGradient()) {
      elasticity_->gradient(positions, &elastic_gradient_);
      integrator_.setElasticGradient(elastic_gradient_);
    }
    at_rest_ = false;
    contact_force_ = support_force_ = 0.0;
    out_ = TissueStep();
  }

  const TissueStep& step(const std::vector<ToolBody>& bodies, double dt) override {
    out_ = TissueStep();
    const double way = dt * velocities().colwise().norm().maxCoeff();
    out_.far_bodies = sweep_.begin(bodies, x_, way);
    sweep_.place(1.0);
    sweep_.search(x_);
    if (at_rest_ && !contact_.hasCandidates()) {
      reportSleep();
      return out_;
    }
    const Points x_begin = x_;
    if (advance(dt)) {
      inertia_forces_ = integrator_.inertiaForces(x_);
      at_rest_ = out_.newton_iterations == 0 && !contact_.hasCandidates() &&
                 (x_ - x_begin).cwiseAbs().maxCoeff() <= rest_motion_ && balancedWithoutInertia();
      if (at_rest_) integrator_.stop();
      reportForces();
    } else {
      integrator_.stop();
      at_rest_ = false;
    }
    reportState();
    return out_;
  }

 private:
  void settleUnderGravity() {
    settled_ = mesh_.points;
    if (settings_.gravity.isZero()) return;
    const std::string motions = fem::freeRigidMotions(mesh_.points, potential_.free);
    if (!motions.empty()) {
      throw std::invalid_argument("gravity would move the body, its supports leave " + motions +
                                  "; hold more of it or set gravity to zero");
    }
    const solver::Potential statics{elasticity_.get(), {&gravity_}, potential_.free, 1.0};
    solver::StaticSettings static_settings;
    static_settings.tolerance = 1e-8;
    const solver::StaticReport report = solver::solveStatic(
        statics,
        [&](double s) {
          gravity_.setFactor(s);
          return mesh_.points;
        },
        static_settings, &settled_);
    gravity_.setFactor(1.0);
    const bool turned_over = elasticity_->minJacobian(settled_) <= 0.0;
    if (report.status != solver::SolveStatus::kConverged || turned_over) {
      throw std::runtime_error("no equilibrium under gravity: the body collapses at " +
                               std::to_string(report.load_factor) +
                               " of its weight; is it too soft or too heavy?");
    }
  }

  // The cycle in one step, or, where that fails, in more and shorter ones. False: x_ is where it
  // was.
  bool advance(double dt) {
    const solver::Integrator begin = integrator_;
    const std::unique_ptr<fem::ViscousState> viscous = elasticity_->saveViscousState();
    for (int steps = 1; steps <= kMaxTimeSteps; steps *= 2) {
      out_.time_steps = steps;
      out_.sweep_stages = 0;
      int done = 0;
      while (done < steps && timeStep(done / double(steps), (done + 1) / double(steps), dt / steps))
        ++done;
      if (done == steps) return true;
      integrator_ = begin;
      x_ = begin.positions();
      elasticity_->restoreViscousState(viscous.get());
    }
    return false;
  }

  // One step of `h`, in which the tools go from `begin` to `end` of their way.
  bool timeStep(double begin, double end, double h) {
    integrator_.beginStep(h, &potential_);
    elasticity_->beginStep(h);
    startFromPredictor(begin, h);
    solveStages(begin, end);
    if (!acceptable()) return false;
    if (integrator_.needsElasticGradient()) elasticity_->gradient(x_, &elastic_gradient_);
    integrator_.endStep(x_, elastic_gradient_);
    elasticity_->endStep(x_);
    return true;
  }

  void startFromPredictor(double s, double h) {
    sweep_.place(s);
    const double value_here = potential_.value(x_);
    const Points way = h * velocities();
    predicted_ = x_ + potential_.maxStep(x_, way) * way;
    const double value_there = potential_.value(predicted_);
    if (value_there < value_here) x_.swap(predicted_);  // false for NaN
  }

  double tolerance() const {
    const double weight = gravity_.forces().norm();
    return settings_.tolerance * std::max({weight, contact_force_, support_force_, force_floor_});
  }

  // The tools go on as far as the tissue can follow, it is solved, and so on to the end.
  void solveStages(double begin, double end) {
    out_.tolerance = tolerance();
    solver::NewtonReport solved;
    for (double s = begin; s < end;) {
      s = sweep_.next(x_, s, end);
      ++out_.sweep_stages;
      sweep_.place(s);
      solved = solveStage(s < end);
    }
    out_.status = solved.status;
    out_.residual = solved.residual;
    out_.satisfied =
        out_.newton_iterations == 0 && solved.status == solver::SolveStatus::kConverged;
  }

  solver::NewtonReport solveStage(bool on_the_way) {
    solver::NewtonSettings newton_settings;
    newton_settings.linear_tolerance = settings_.linear_tolerance;
    newton_settings.tolerance = (on_the_way ? kStageTolerance : 1.0) * out_.tolerance;
    newton_settings.max_iterations =
        on_the_way ? kStageIterations : settings_.max_newton_iterations;
    solver::NewtonReport solved;
    for (int search = 0; search < kMaxSearches; ++search) {
      solved = newton_.minimize(potential_, newton_settings, &linear_, &x_);
      out_.newton_iterations += solved.iterations;
      out_.linear_iterations += solved.linear_iterations;
      if (sweep_.candidatesHold(x_)) break;
      sweep_.search(x_);
    }
    return solved;
  }

  // A state to go on from. One that only ran out of iterations is: each of them lowered the energy.
  bool acceptable() const {
    return (out_.ok() || out_.status == solver::SolveStatus::kIterationLimit) && x_.allFinite();
  }

  // The body would not begin to move if it were stopped here.
  bool balancedWithoutInertia() const {
    const Points unbalanced = newton_.gradient() + inertia_forces_;
    return unbalanced.cwiseProduct(potential_.free).norm() <= out_.tolerance;
  }

  void reportForces() {
    out_.gravity_force = gravity_.forces().rowwise().sum();
    out_.inertia_force = inertia_forces_.rowwise().sum();
    const Points support = newton_.gradient().array() * (1.0 - potential_.free.array());
    out_.support_force = support.rowwise().sum();
    support_force_ = support.norm();
    contact_.collect(x_, &contacts_);
    Points nodal = Points::Zero(3, x_.cols());
    for (const contact::Contact& c : contacts_) {
      out_.contacts.push_back({sweep_.instrument(c.body), c.penetration, c.p_W, c.force_W});
      const contact::SurfaceSample& s = contact_.samples()[c.sample];
      for (int k = 0; k < 3; ++k) nodal.col(s.nodes[k]) += s.weights[k] * c.force_W;
    }
    contact_force_ = nodal.norm();
  }

  void reportState() {
    out_.min_jacobian = elasticity_->minJacobian(x_);
    out_.kinetic_energy =
        0.5 *
        velocities().colwise().squaredNorm().transpose().cwiseProduct(integrator_.masses()).sum();
    out_.elastic_energy = elasticity_->energy(x_);
    last_ = out_;
  }

  // Nothing has changed since the last cycle, at whose end the body came to rest.
  void reportSleep() {
    const int far = out_.far_bodies;
    out_ = last_;
    out_.far_bodies = far;
    out_.slept = true;
    out_.satisfied = false;
    out_.newton_iterations = out_.linear_iterations = 0;
    out_.inertia_force.setZero();
    out_.sweep_stages = 1;
  }

  FemSettings settings_;
  mesh::TetMesh mesh_;
  double size_;  // diagonal of the rest bounding box [m]
  Points settled_;
  Eigen::Matrix3Xi triangles_;
  std::unique_ptr<fem::Elasticity> elasticity_;
  solver::Integrator integrator_;
  fem::DeadLoad gravity_;
  contact::ContactPotential contact_;
  ToolSweep sweep_;
  solver::Potential potential_;
  solver::BlockPcg linear_;
  solver::Newton newton_;
  double force_floor_ = 0.0;  // [N]
  double rest_motion_ = 0.0;  // [m]

  Points x_, elastic_gradient_, inertia_forces_;
  bool at_rest_ = false;
  double contact_force_ = 0.0, support_force_ = 0.0;  // nodal norms of the last cycle [N]

  // One cycle's.
  std::vector<contact::Contact> contacts_;
  Points predicted_;
  TissueStep out_, last_;
};

}  // namespace

std::unique_ptr<TissueModel> makeFemTissue(const mesh::TetMesh& mesh,
                                           const fem::Composition& composition,
                                           const fem::FreeMask& free, const FemSettings& settings,
                                           ThreadPool* pool) {
  return std::make_unique<FemTissue>(mesh, composition, free, settings, pool);
}

}  // namespace palpate::tissue
