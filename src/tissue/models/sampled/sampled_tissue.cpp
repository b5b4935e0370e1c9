// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampled_tissue.h"

#include <algorithm>
#include <cmath>

namespace palpate::tissue {
namespace {

// Largest displacement of a particle by contact in a sub-step, over the least distance of particles
// [-]; more comes from a contact that began deep.
constexpr double kContactWay = 0.5;

}  // namespace

// Number of sub-steps of the cycle; 0: too many for stability. The published rule by velocities is
// capped and reported, since forces do not decrease at rest.
int SampledTissue::planSteps(double dt, bool* coarse) {
  const double stable = std::max(1.0, std::ceil(dt / stableStep()));
  double wanted = stable;
  if (most_change_ > 0.0) {
    Vec3 anchors;
    body_.umbrella().forces(body_.d, &forces_, &anchors);
    forces_ += gravity_ * body_.masses.transpose();
    double most = 0.0;
    for (Eigen::Index i = 0; i < forces_.cols(); ++i) {
      most = std::max(most, forces_.col(i).norm() / body_.masses[i]);
    }
    if (most > 0.0) wanted = std::max(wanted, std::ceil(dt / (most_change_ / most)));
  }
  *coarse = !(wanted <= kMostSubSteps);
  return stable <= kMostSubSteps ? static_cast<int>(std::min(wanted, 1.0 * kMostSubSteps)) : 0;
}

// Without refinement that would need more sub-steps than allowed.
bool SampledTissue::adapt(double dt) {
  before_.clear();
  body_.save(&before_);
  if (!body_.adapt()) return false;
  if (std::ceil(std::max(dt, step_) / stableStep()) <= kMostSubSteps) return true;
  StateReader back(before_.bytes());
  body_.restore(&back);
  return false;
}

// Whether displacements by contact are plausible.
bool SampledTissue::subStep(double h, double s) {
  tool_contact_.tool_path.beginStep(x_);
  tool_contact_.tool_path.moveTo(s);
  if (!tool_contact_.tool_path.candidatesHold(x_)) tool_contact_.tool_path.search(x_);
  forces_ = gravity_ * body_.masses.transpose();
  if (tool_contact_.contact.hasCandidates()) {
    on_surface_.setZero();
    tool_contact_.contact.addGradient(x_, &on_surface_);
    on_surface_ *= -1.0;
    contact_.setZero(3, forces_.cols());
    body_.surface().addForces(on_surface_, &contact_);
    for (Eigen::Index i = 0; i < contact_.cols(); ++i) {
      if (!(h * h * contact_.col(i).norm() <= kContactWay * finest_ * body_.masses[i]))
        return false;
    }
    forces_ += contact_;
  }
  for (const Umbrella::Link& link : body_.umbrella().links()) {
    Vec3 way = -body_.d.col(link.a) - lag_ * body_.v.col(link.a), on_b;
    if (link.b >= 0) way += body_.d.col(link.b) + lag_ * body_.v.col(link.b);
    forces_.col(link.a) += Umbrella::force(link, way, &on_b);
    if (link.b >= 0) forces_.col(link.b) += on_b;
  }
  for (Eigen::Index i = 0; i < forces_.cols(); ++i) {
    body_.v.col(i) = (body_.v.col(i) + h / body_.masses[i] * forces_.col(i)) / (1.0 + damping_ * h);
    body_.d.col(i) += h * body_.v.col(i);
  }
  body_.surface().interpolate(body_.d, &x_);
  x_ += X_;
  tool_contact_.contact.endStep(x_);
  return true;
}

const TissueStep& SampledTissue::step(const std::vector<contact::Obstacle>& obstacles, double dt) {
  out_.clear();
  tool_contact_.begin(obstacles, x_, surface_v_, dt, &out_);
  if (rest_.sleeps(tool_contact_)) {
    rest_.report(&out_);
    return out_;
  }
  rest_.begin(x_);
  before_.clear();
  body_.save(&before_);
  tool_contact_.tool_path.moveTo(0.0);
  out_.tolerance = tolerance_;
  bool coarse = false;
  const int steps = planSteps(dt, &coarse);
  int done = 0;
  bool late = false;
  while (done < steps && !late && subStep(dt / steps, (done + 1) / static_cast<double>(steps))) {
    ++done;
    late = done < steps && solver::isInterrupted(interrupt_);
  }
  out_.sweep_stages = done;
  if (steps == 0 || (done < steps && !late) || !body_.d.allFinite() || !body_.v.allFinite()) {
    StateReader back(before_.bytes());
    body_.restore(&back);
    body_.v.setZero();
    tool_contact_.inside_tools.invalidate();
    tool_contact_.contact.forget();
    follow();
    out_.recover(Recovery::kRolledBack);
    out_.status = steps == 0     ? solver::SolveStatus::kIterationLimit
                  : done < steps ? solver::SolveStatus::kLineSearchFailed
                                 : solver::SolveStatus::kNonFinite;
    return out_;
  }
  body_.surface().interpolate(body_.v, &surface_v_);
  if (late) {  // the tissue has not followed the tools
    tool_contact_.inside_tools.invalidate();
    out_.status = solver::SolveStatus::kDeadline;
  } else {
    tool_contact_.contact.learn(x_, dt);
    if (coarse) out_.status = solver::SolveStatus::kIterationLimit;
  }
  report();
  if (rest_.sleeps(tool_contact_)) {
    endAtRest();
  } else if (adapt(dt)) {
    follow();
  }
  return out_;
}

void SampledTissue::report() {
  Vec3 support;
  body_.umbrella().forces(body_.d, &forces_, &support);
  forces_ += gravity_ * body_.masses.transpose();
  out_.elastic_energy = body_.umbrella().energy(body_.d);
  out_.kinetic_energy = 0.5 * body_.v.colwise().squaredNorm().dot(body_.masses.transpose());
  if (rest_.isStill(x_, tool_contact_, out_) && forces_.norm() <= tolerance_) {
    rest_.fallAsleep();
    body_.v.setZero();
    surface_v_.setZero();
  }
  out_.support_force = -support;
  out_.gravity_force = gravity_ * body_.masses.sum();
  tool_contact_.report(x_, &out_);
  out_.inertia_force = -forces_.rowwise().sum();
  for (const TissueContact& c : out_.contacts) out_.inertia_force += c.force_W;
  tool_contact_.countInactive(&out_);
  rest_.remember(out_);
}

void SampledTissue::setPositions(int, const Points& positions, const Points& velocities) {
  body_.reset();
  const auto& particles = body_.tree().particles();
  for (std::size_t k = 0; k < body_.leaves().size(); ++k) {
    const Vec3 X = particles[static_cast<std::size_t>(body_.leaves()[k])].X;
    Eigen::Index nearest = 0;
    (X_.colwise() - X).colwise().squaredNorm().minCoeff(&nearest);
    body_.d.col(static_cast<Eigen::Index>(k)) = positions.col(nearest) - X_.col(nearest);
    body_.v.col(static_cast<Eigen::Index>(k)) = velocities.col(nearest);
  }
  forget();
}

}  // namespace palpate::tissue
