// SPDX-License-Identifier: GPL-3.0-or-later
#include "spring_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

#include "tissue/methods/explicit/critical_step.h"

namespace palpate::tissue {
namespace {

constexpr double kSafety = 0.9;
constexpr double kMaxSubSteps = 1e5;
constexpr int kMaxCaution = 8, kCautionForGain = 2;
// Largest ratio of energy gained to energy supplied [-]; the supply includes a fraction of the
// springs' capacity, for tools that begin in tissue.
constexpr double kEnergyGain = 4.0, kOfSprings = 0.1;

// Upper bound of damping rates: twice the largest sum of dampers at a point over its mass.
double ownDamping(const SpringArrays& springs, const Eigen::VectorXd& masses) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(masses.size());
  for (int s = 0; s < springs.size(); ++s) {
    sums[springs.a(s)] += springs.damping(s);
    sums[springs.b(s)] += springs.damping(s);
  }
  return 2.0 * sums.cwiseQuotient(masses).maxCoeff();
}

double stretched(const SpringArrays& springs) {
  double sum = 0.0;
  for (int s = 0; s < springs.size(); ++s) {
    sum += 0.5 * springs.stiffness(s) * springs.length(s) * springs.length(s);
  }
  return sum;
}

Eigen::VectorXd forcesStretched(const SpringArrays& springs, Eigen::Index points) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(points);
  for (int s = 0; s < springs.size(); ++s) {
    sums[springs.a(s)] += springs.stiffness(s) * springs.length(s);
    sums[springs.b(s)] += springs.stiffness(s) * springs.length(s);
  }
  return sums;
}

std::vector<int> ends(const SpringArrays& springs, bool first) {
  std::vector<int> all;
  all.reserve(static_cast<std::size_t>(springs.size()));
  for (int s = 0; s < springs.size(); ++s) all.push_back(first ? springs.a(s) : springs.b(s));
  return all;
}

std::string inSeconds(double value) {
  std::ostringstream text;
  text.precision(3);
  text << value;
  return text.str();
}

}  // namespace

SpringSteps::SpringSteps(FemBody* body, const SpringForces* springs,
                         const SpringStepSettings& settings)
    : body_(*body),
      forces_(*springs),
      settings_(settings),
      masses_(body->elasticity->masses()),
      own_damping_(ownDamping(springs->springs(), masses_)),
      minus_weight_(-body->gravity.forces()),
      loads_vary_(!body->surroundings.empty() || !body->drive.loads.empty()),
      square_(springs->largestSquare() + settings.load_square +
              body->surroundings.largestSquare(body->mesh.points, masses_)),
      contact_(body),
      region_(body->mesh.points, settings.radius, ends(springs->springs(), true),
              ends(springs->springs(), false)),
      all_springs_(stretched(springs->springs())),
      strong_(forcesStretched(springs->springs(), masses_.size())) {
  CriticalStep critical(body->elasticity.get(), body->free,
                        body->surroundings.largestSquare(body->mesh.points, masses_));
  critical.begin(body->mesh.points);
  g_ = contact_g_ = next_ = way_ = held_way_ = Points::Zero(3, masses_.size());
  const std::string name = settings.integrator->name;
  const double at_rest = longestStep(4.0 / (critical.seconds() * critical.seconds()));
  if (!(at_rest > 0.0)) {
    throw std::invalid_argument("springs.scheme = " + name +
                                ": any step of it makes what is not damped grow; give damping.mass "
                                "or damping.stiffness, or choose symplectic_euler or implicit");
  }
  if (settings.step > at_rest) {
    throw std::invalid_argument("springs.step = " + inSeconds(settings.step) + ": " + name +
                                " is stable up to " + inSeconds(at_rest) + " s with these springs");
  }
  longest_ = kSafety * longestStep(square_);
  if (settings.step > 0.0) longest_ = std::min(longest_, settings.step);
  if (const double longest = body->settings.step; !(longest <= kMaxSubSteps * longest_)) {
    throw std::invalid_argument(
        "springs.scheme = " + name + ": solver.step = " + inSeconds(longest) + " takes more than " +
        inSeconds(kMaxSubSteps) + " of its steps of " + inSeconds(longest_) +
        " s; shorten solver.step, lengthen springs.step where it is given, damp more, or choose " +
        (name == "symplectic_euler" ? "implicit" : "symplectic_euler or implicit"));
  }
  body->method = name;
  body->method_note = name + " in steps of " + inSeconds(longest_) + " s; at rest those up to " +
                      inSeconds(at_rest) + " s are stable";
}

// Largest stable step of modes up to a squared frequency [s].
double SpringSteps::longestStep(double square) const {
  if (!(square > 0.0)) return std::numeric_limits<double>::infinity();
  const double d = body_.settings.mass_damping + body_.settings.stiffness_damping * square;
  return settings_.integrator->longest(square, d, d + own_damping_);
}

void SpringSteps::restart() {
  contact_.clear();
  contact_g_.setZero();
  account_ = Account();
  region_.setAll();
  addForces(&g_);
}

void SpringSteps::save(StateWriter* out) const {
  out->put(contact_g_);
  for (const double d : {account_.all, account_.own, account_.work}) out->put(d);
  out->put(account_.open);
  region_.save(out);
}

void SpringSteps::restore(StateReader* in) {
  contact_.clear();
  in->getSame(&contact_g_);
  for (double* d : {&account_.all, &account_.own, &account_.work}) in->get(d);
  in->get(&account_.open);
  region_.restore(in);
  addForces(&g_);
}

// Computes minus all forces but contact and mass damping, of springs with a moving end.
void SpringSteps::addForces(Points* g) const {
  if (loads_vary_) {
    g->setZero();
    body_.addLoads(body_.x, g);
  } else {
    *g = minus_weight_;
  }
  const SpringArrays& springs = forces_.springs();
  if (region_.whole()) {
    springs.addGradient(body_.x, g);
  } else {
    springs.addGradient(body_.x, region_.springs(), g);
  }
  const double ratio = body_.settings.stiffness_damping;
  if (ratio > 0.0 || springs.damps()) {
    springs.addDamping(body_.x, body_.v, ratio, region_.springs(), g);
  }
}

bool SpringSteps::advance(double dt, TissueStep* out) {
  out->status = solver::SolveStatus::kNonFinite;
  if (!body_.v.allFinite()) return false;
  out->tolerance = body_.tolerance();
  const double steps = std::max({1.0, std::ceil(dt / longest_), contact_.steps()});
  if (!(steps <= kMaxSubSteps)) {
    out->status = solver::SolveStatus::kIterationLimit;
    return false;
  }
  begin_x_ = body_.x;
  begin_v_ = body_.v;
  touched_.clear();
  body_.contact.save(&touched_);
  for (int finer = 1; finer <= kMaxCaution; finer *= 2) {
    out->time_steps = finer;
    if (run(dt, finer * static_cast<int>(steps), out)) return true;
    const bool late = solver::isInterrupted(body_.interrupt);
    body_.x = begin_x_;
    body_.v = begin_v_;
    StateReader before(touched_.bytes());
    body_.contact.restore(&before);
    if (gained_ && finer >= kCautionForGain) return false;
    if (late && finer < kMaxCaution) {
      out->status = solver::SolveStatus::kDeadline;  // without an attempt of finer sub-steps
      return false;
    }
  }
  return false;
}

bool SpringSteps::run(double dt, int steps, TissueStep* out) {
  const double h = dt / steps;
  coefficients_ = masses_ / (h * h);
  out->sweep_stages = steps;
  contact_.begin();
  work_ = 0.0;
  touched_now_ = gained_ = false;
  bool late = false;
  for (int k = 1; k <= steps && !late; ++k) {
    if (!subStep(h, k / static_cast<double>(steps), out)) {
      out->status = solver::SolveStatus::kLineSearchFailed;
      return false;
    }
    region_.addAround(contact_.nodes());
    late = k < steps && solver::isInterrupted(body_.interrupt);
  }
  // The springs have not followed the tools.
  if (late) body_.tool_contact.inside_tools.invalidate();
  if (!body_.x.allFinite() || !body_.v.allFinite()) return false;
  gained_ = !plausible();
  if (gained_) {
    out->status = solver::SolveStatus::kLineSearchFailed;
    return false;
  }
  contact_g_ = contact_.gradient();
  addForces(&g_);
  out->residual = contact_.residual();
  out->still_points = static_cast<int>(masses_.size()) - static_cast<int>(region_.points().size());
  body_.contact.learn(body_.x, dt);
  out->status = contact_.status(out->tolerance, late);
  if (out->status != solver::SolveStatus::kDeadline) clearRegionAtRest(*out);
  return true;
}

// Energy at x, v [J]: total, and `own` without loads.
double SpringSteps::energy(const Points& x, const Points& v, double* own) {
  way_.setZero();
  *own = 0.5 * v.colwise().squaredNorm().dot(masses_.transpose()) + body_.elasticity->energy(x);
  return *own + body_.addLoads(x, &way_);
}

// Whether the energy gained since tools touch is within their work.
bool SpringSteps::plausible() {
  const bool counts = touched_now_ && !body_.heldMoves() && !body_.surroundings.moves();
  Account account = counts ? account_ : Account();
  if (counts) {
    if (!account.open) account.all = energy(begin_x_, begin_v_, &account.own);
    account.open = true;
    account.work += work_;
    double own = 0.0;
    const double gained = energy(body_.x, body_.v, &own) - account.all;
    const double given = account.own + account.work + kOfSprings * all_springs_;
    if (gained > kEnergyGain * given) return false;
  }
  account_ = account;
  return true;
}

// Computes a sub-step of `h` [s] with the tools moved to fraction `s` of their path.
bool SpringSteps::subStep(double h, double s, TissueStep* out) {
  body_.surroundings.moveTo(s);
  {
    const PhaseTimer timer(&out->phases, Phase::kForces);
    addForces(&g_);
  }
  next_.setZero();
  way_.setZero();
  const double drag = body_.settings.mass_damping;
  for (const int i : region_.points()) {
    Vec3 v = body_.v.col(i);
    const Vec3 a = -g_.col(i) / masses_[i] - drag * v;
    way_.col(i) = settings_.integrator->go(h, a.cwiseProduct(body_.free.col(i)), &v);
    body_.v.col(i) = v;
    next_.col(i) = h * v;
  }
  if (body_.heldMoves() && body_.heldWay(s, &held_way_)) {
    body_.v = body_.v.cwiseProduct(body_.free) + held_way_ / h;
    way_ = way_.cwiseProduct(body_.free) + held_way_;
    next_ = next_.cwiseProduct(body_.free) + held_way_;
  }
  {
    const PhaseTimer timer(&out->phases, Phase::kContact);
    if (!contact_.step(s, coefficients_, &next_)) return false;
  }
  way_ += body_.x;
  for (const int i : contact_.nodes()) {
    work_ += std::min(contact_.gradient().col(i).norm(), strong_[i]) * contact_.toolWay();
    touched_now_ = true;
    way_.col(i) = next_.col(i);
    body_.v.col(i) = (next_.col(i) - body_.x.col(i)) / h;
  }
  body_.x.swap(way_);
  body_.contact.endStep(body_.x);
  return true;
}

// Empties the moving region once nothing is touched and all points rest.
void SpringSteps::clearRegionAtRest(const TissueStep& out) {
  if (!contact_.nodes().empty()) return;
  const double kinetic = 0.5 * body_.v.colwise().squaredNorm().dot(masses_.transpose());
  if (kinetic > 1e-9 * out.tolerance * body_.size || unbalancedForce() > out.tolerance) return;
  for (const int i : region_.points()) body_.v.col(i).setZero();
  region_.clear();
}

double SpringSteps::unbalancedForce() {
  double square = 0.0;
  for (const int i : region_.points()) {
    square += (g_.col(i) + contact_g_.col(i)).cwiseProduct(body_.free.col(i)).squaredNorm();
  }
  return std::sqrt(square);
}

void SpringSteps::reportForces(TissueStep* out) {
  next_ = g_ + contact_g_;
  Vec3 accelerating = Vec3::Zero();
  for (const int i : region_.points()) {
    accelerating += next_.col(i).cwiseProduct(body_.free.col(i));
  }
  out->inertia_force = accelerating;
  body_.reportSupport(next_, out);
  // Support forces of fixed points.
  for (Eigen::Index i = 0; i < next_.cols(); ++i) {
    if (!region_.moves(static_cast<int>(i))) {
      out->support_force += next_.col(i).cwiseProduct(body_.free.col(i));
    }
  }
  body_.reportContacts(out);
}

}  // namespace palpate::tissue
