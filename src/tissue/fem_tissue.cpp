// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/fem_tissue.h"

#include "fem_body.h"
#include "step_method.h"

namespace palpate::tissue {
namespace {

// A body at rest moves less than this part of its size in a cycle.
constexpr double kRestMotion = 1e-6;
// A viscous one may creep far in many cycles.
constexpr double kRestMotionViscous = 1e-9;

class FemTissue final : public TissueModel {
 public:
  FemTissue(const mesh::TetMesh& mesh, const fem::Composition& composition,
            const fem::FreeMask& free, const FemSettings& settings, ThreadPool* pool)
      : body_(mesh, composition, free, settings, pool),
        method_(makeStepMethod(settings.method, &body_)),
        rest_motion_((body_.elasticity->viscous() ? kRestMotionViscous : kRestMotion) * body_.size),
        settled_(settleUnderGravity(&body_)) {
    method_->settle(&settled_);
    FemTissue::reset();
  }

  const mesh::TetMesh& restMesh() const override { return body_.mesh; }
  const Points& positions() const override { return body_.x; }
  const Points& velocities() const override { return body_.v; }
  const Eigen::Matrix3Xi& surfaceTriangles() const override { return body_.triangles; }

  std::vector<std::string> methods() const override { return {body_.method}; }

  std::vector<std::string> notes() const override {
    if (body_.method_note.empty()) return {};
    return {body_.method_note};
  }

  void setInterrupt(const solver::Interrupt* interrupt) override { body_.interrupt = interrupt; }

  void reset() override { restore(settled_, Points::Zero(3, settled_.cols())); }

  void restore(const Points& positions, const Points& velocities) override {
    body_.x = positions;
    body_.v = velocities;
    body_.elasticity->relax(positions);
    body_.elastic_energy.reset();
    body_.contact_force = body_.support_force = 0.0;
    method_->restart();
    at_rest_ = false;
    out_.clear();
  }

  const TissueStep& step(const std::vector<ToolBody>& bodies, double dt) override {
    begin(bodies, dt);
    if (at_rest_ && !body_.contact.hasCandidates()) {
      reportSleep();
      return out_;
    }
    x_begin_ = body_.x;
    if (method_->advance(dt, &out_)) {
      at_rest_ = body_.settings.skip.sleeping && cameToRest();
      if (at_rest_) stop();
      out_.gravity_force = body_.weight;
      method_->reportForces(&out_);
      out_.inviscid_solids = body_.inviscid_solids;
      if (body_.settings.skip.inactive_samples) {
        out_.inactive_samples =
            body_.contact.numCandidates() - static_cast<int>(out_.contacts.size());
      }
    } else {
      stop();
      at_rest_ = false;
    }
    reportState();
    return out_;
  }

 private:
  void begin(const std::vector<ToolBody>& bodies, double dt) {
    out_.clear();
    const PhaseTimer timer(&out_.phases, Phase::kContact);
    const double way = dt * body_.v.colwise().norm().maxCoeff();
    out_.far_bodies = body_.sweep.begin(bodies, body_.x, way);
    body_.sweep.place(1.0);
    body_.sweep.search(body_.x);
    out_.distant_samples = body_.contact.numDistant();
  }

  // It neither moves nor would begin to if it were stopped here.
  bool cameToRest() {
    return out_.newton_iterations == 0 && !body_.contact.hasCandidates() &&
           (body_.x - x_begin_).cwiseAbs().maxCoeff() <= rest_motion_ &&
           method_->unbalancedForce() <= out_.tolerance;
  }

  void stop() {
    body_.v.setZero();
    method_->stop();
  }

  void reportState() {
    const PhaseTimer timer(&out_.phases, Phase::kForces);
    out_.min_jacobian = body_.elasticity->minJacobian(body_.x);
    out_.kinetic_energy =
        0.5 * body_.v.colwise().squaredNorm().transpose().cwiseProduct(method_->masses()).sum();
    const std::optional<double> own = method_->elasticEnergy();
    out_.elastic_energy = own ? *own : body_.elasticity->energy(body_.x);
    if (!own && !body_.elasticity->viscous()) body_.elastic_energy = out_.elastic_energy;
    last_ = out_;
  }

  // Nothing has changed since the last cycle, at whose end the body came to rest.
  void reportSleep() {
    const int far = out_.far_bodies;
    const int distant = out_.distant_samples;
    const PhaseTimes phases = out_.phases;
    out_ = last_;
    out_.far_bodies = far;
    out_.distant_samples = distant;
    out_.inactive_samples = out_.inviscid_solids = out_.kept_stiffnesses = 0;
    out_.phases = phases;
    out_.slept = true;
    out_.satisfied = false;
    out_.newton_iterations = out_.linear_iterations = 0;
    out_.inertia_force.setZero();
    out_.sweep_stages = 1;
  }

  FemBody body_;
  std::unique_ptr<StepMethod> method_;
  double rest_motion_;  // [m]
  Points settled_, x_begin_;
  bool at_rest_ = false;
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
