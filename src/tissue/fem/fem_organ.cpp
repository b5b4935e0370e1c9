// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/fem/fem_tissue.h"

#include "fem_body.h"
#include "step_method.h"
#include "tissue/touch/rest.h"

namespace palpate::tissue {
namespace {

class FemTissue final : public TissueModel {
 public:
  FemTissue(const mesh::TetMesh& mesh, const fem::Composition& composition,
            const fem::FreeMask& free, const FemSettings& settings, ThreadPool* pool)
      : body_(mesh, composition, free, settings, pool),
        method_(makeStepMethod(settings.method, &body_)),
        rest_((body_.elasticity->viscous() ? Rest::kMotionCreeping : Rest::kMotion) * body_.size,
              settings.skip.sleeping),
        settled_(settleUnderGravity(&body_)) {
    method_->settle(&settled_);
    FemTissue::reset();
  }

  Shape shape(int) const override { return {body_.x, body_.v, body_.triangles, 0}; }
  mesh::CellMesh cells(int) const override { return mesh::cellsOf(body_.mesh); }

  std::vector<std::string> methods() const override { return {body_.method}; }

  std::vector<std::string> notes() const override {
    if (body_.method_note.empty()) return {};
    return {body_.method_note};
  }

  void setInterrupt(const solver::Interrupt* interrupt) override { body_.interrupt = interrupt; }

  void reset() override { place(0, settled_, Points::Zero(3, settled_.cols())); }

  void place(int, const Points& positions, const Points& velocities) override {
    body_.x = positions;
    body_.v = velocities;
    body_.elasticity->relax(positions);
    body_.contact.forget();
    body_.elastic_energy.reset();
    body_.contact_force = body_.support_force = 0.0;
    method_->restart();
    rest_.wake();
    out_.clear();
  }

  State state() const override {
    StateWriter out;
    body_.save(&out);
    method_->save(&out);
    rest_.save(&out);
    return {stateKind(body_.settings, body_.x.cols()), out.bytes()};
  }

  void restore(const State& state) override {
    checkKind(state, stateKind(body_.settings, body_.x.cols()));
    StateReader in(state.bytes);
    body_.restore(&in);
    method_->restore(&in);
    rest_.restore(&in);
    in.finish();
    out_.clear();
  }

  const TissueStep& step(const std::vector<contact::Obstacle>& obstacles, double dt) override {
    out_.clear();
    body_.touch.begin(obstacles, body_.x, body_.v, dt, &out_);
    if (rest_.sleeps(body_.touch)) {
      rest_.report(&out_);
      return out_;
    }
    rest_.begin(body_.x);
    if (method_->advance(dt, &out_)) {
      if (cameToRest()) {
        rest_.fallAsleep();
        stop();
      }
      out_.gravity_force = body_.weight;
      method_->reportForces(&out_);
      out_.inviscid_solids = body_.inviscid_solids;
      body_.touch.countInactive(&out_);
    } else {
      stop();
    }
    reportState();
    return out_;
  }

 private:
  // It neither moves nor would begin to if it were stopped here.
  bool cameToRest() {
    return rest_.isStill(body_.x, body_.touch, out_) &&
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
    rest_.remember(out_);
  }

  FemBody body_;
  std::unique_ptr<StepMethod> method_;
  Rest rest_;
  Points settled_;
  TissueStep out_;
};

}  // namespace

std::string stateKind(const FemSettings& settings, Eigen::Index num_points) {
  return "fem " + settings.method + " " + settings.integrator + " " + settings.element + " " +
         settings.contact.model + ", " + std::to_string(num_points) + " points";
}

std::unique_ptr<TissueModel> makeFemTissue(const mesh::TetMesh& mesh,
                                           const fem::Composition& composition,
                                           const fem::FreeMask& free, const FemSettings& settings,
                                           ThreadPool* pool) {
  return std::make_unique<FemTissue>(mesh, composition, free, settings, pool);
}

}  // namespace palpate::tissue
