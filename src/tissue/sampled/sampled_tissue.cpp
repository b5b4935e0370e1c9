// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampled_tissue.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "palpate/base/number.h"
#include "palpate/base/state_bytes.h"
#include "sampled_body.h"
#include "tissue/touch/rest.h"

namespace palpate::tissue {
namespace {

constexpr double kSafety = 0.7;     // of the bound of the stable step
constexpr double kContact = 100.0;  // shear moduli over the least distance of particles
// Contact moves no particle farther in a sub-step than this part of the least distance of them:
// what does was not there in the sub-step before, and would throw it.
constexpr double kContactWay = 0.5;
constexpr int kMostSubSteps = 20000;
constexpr int kMostAdaptations = 12;
constexpr int kMostSettlingSteps = 200000;
constexpr double kSameRest = 0.01;  // of its size: so far the parting of particles may move a rest

// The least distance of particles [m].
double finestOf(const SamplingSettings& sampling) {
  return sampling.coarsest / (1 << (sampling.levels - 1));
}

class SampledTissue final : public TissueModel {
 public:
  SampledTissue(const mesh::TetMesh& mesh, const fem::FreeMask& free, const material::Solid& solid,
                const OrganDescription& organ, const ModelSettings& settings)
      : X_(mesh.points),
        triangles_(mesh::trianglesOf(mesh::boundaryFaces(mesh))),
        body_(mesh, organ.X_WO, X_, heldParts(free, organ.sampling), material::moduli(solid.law),
              solid.density, organ.sampling),
        gravity_(settings.gravity),
        damping_(organ.damping.mass),
        lag_(organ.damping.stiffness),
        finest_(finestOf(organ.sampling)),
        most_change_(organ.sampling.max_velocity_change),
        touch_(X_, triangles_, settings),
        size_((X_.rowwise().maxCoeff() - X_.rowwise().minCoeff()).norm()),
        rest_(Rest::kMotion * size_, settings.skip.sleeping),
        tolerance_(settings.tolerance * (settings.gravity.norm() * body_.masses.sum() +
                                         0.01 * material::moduli(solid.law).mu * size_ * size_) +
                   1e-9) {
    Eigen::VectorXd stiffness = Eigen::VectorXd::Zero(X_.cols());
    for (const contact::SurfaceSample& sample : touch_.contact.samples()) {
      for (int k = 0; k < 3; ++k) {
        stiffness[sample.nodes[k]] += sample.weights[k] * sample.area * settings.contact.stiffness;
      }
    }
    body_.setContactStiffness(stiffness);
    x_ = X_;
    surface_v_ = on_surface_ = Points::Zero(3, X_.cols());
    settle();
    SampledTissue::reset();
    refuseTooManySubSteps(settings.step);
  }

  Shape shape(int) const override { return {x_, surface_v_, triangles_, 0}; }
  mesh::CellMesh cells(int) const override {
    mesh::CellMesh cells;
    cells.points = X_;
    cells.cells = triangles_;
    return cells;
  }
  std::vector<std::string> notes() const override {
    std::ostringstream text;
    text.precision(3);
    text << body_.leaves().size() << " particles at rest, steps of " << stableStep()
         << " s; the published rule allows "
         << body_.umbrella().publishedStep(body_.tree().particles().front().size) << " s";
    return {text.str()};
  }
  void setInterrupt(const solver::Interrupt* interrupt) override { interrupt_ = interrupt; }

  const TissueStep& step(const std::vector<contact::Obstacle>& obstacles, double dt) override;

  void reset() override {
    StateReader in(settled_.bytes());
    body_.restore(&in);
    body_.v.setZero();
    forget();
  }
  /// The particles take what the surface says: where it is, all others as the nearest ones.
  void place(int, const Points& positions, const Points& velocities) override;

  State state() const override {
    StateWriter out;
    body_.save(&out);
    touch_.save(&out);
    rest_.save(&out);
    return {kind(), out.bytes()};
  }
  void restore(const State& state) override {
    checkKind(state, kind());
    StateReader in(state.bytes);
    body_.restore(&in);
    touch_.restore(&in);
    rest_.restore(&in);
    in.finish();
    follow();
  }

 private:
  // Of the triangles all of whose corners are, parts smaller than the smallest particles.
  std::vector<Umbrella::Anchor> heldParts(const fem::FreeMask& free,
                                          const SamplingSettings& sampling) const {
    std::vector<Umbrella::Anchor> parts;
    for (Eigen::Index t = 0; t < triangles_.cols(); ++t) {
      Mat3 corners;
      bool held = true;
      for (int k = 0; k < 3; ++k) {
        held = held && free.col(triangles_(k, t)).isZero();
        corners.col(k) = X_.col(triangles_(k, t));
      }
      if (!held) continue;
      const Vec3 u = corners.col(1) - corners.col(0), v = corners.col(2) - corners.col(0);
      const int n =
          static_cast<int>(std::ceil(3.0 * std::max(u.norm(), v.norm()) / finestOf(sampling)));
      const Vec3 area = 0.5 * u.cross(v) / (n * n);
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < 2 * (n - i) - 1; ++j) {  // upright and upside down in turn
          const double a = (i + (j % 2 + 1) / 3.0) / n,
                       b = (std::floor(0.5 * j) + (j % 2 + 1) / 3.0) / n;
          parts.push_back({-1, corners.col(0) + a * u + b * v, area});
        }
      }
    }
    return parts;
  }
  std::string kind() const {
    return "sampled_elasticity, " + std::to_string(X_.cols()) + " points";
  }
  void forget() {
    touch_.forget();
    rest_.wake();
    out_.clear();
    follow();
  }
  // The surface.
  void follow() {
    body_.surface().interpolate(body_.d, &x_);
    x_ += X_;
    body_.surface().interpolate(body_.v, &surface_v_);
  }
  // With damping of all but contact, see SpringIntegrator.
  double stableStep() const {
    const double w = 2.0 / body_.longestSteps().minCoeff(), own = 2.0 / body_.longestAlone();
    const double d = damping_ + lag_ * own * own;
    return kSafety * (std::sqrt(d * d + 4.0 * w * w) - d) / (w * w);
  }
  void refuseTooManySubSteps(double dt) const;
  void settle();
  bool comeToRest();
  void endAtRest();
  int planSteps(double dt);
  bool subStep(double h, double s);
  void report();

  Points X_;
  Eigen::Matrix3Xi triangles_;
  SampledBody body_;
  Vec3 gravity_;
  double damping_;  // by mass [1/s]
  double lag_;      // by stiffness [s]
  double finest_;   // distance of particles [m]
  double most_change_;
  Touch touch_;
  double size_;
  Rest rest_;
  double tolerance_;
  StateWriter settled_, before_;  // the cycle
  Points x_, surface_v_, on_surface_, forces_, contact_;
  const solver::Interrupt* interrupt_ = nullptr;
  TissueStep out_;
};

// Cycles would all end where they begin.
void SampledTissue::refuseTooManySubSteps(double dt) const {
  const double steps = std::ceil(dt / stableStep());
  if (steps <= kMostSubSteps) return;
  throw std::invalid_argument(
      "model sampled_elasticity: a cycle of solver.step = " + formatNumber(dt) + " s takes " +
      formatNumber(steps) + " sub-steps of " + formatNumber(stableStep()) + " s at rest, at most " +
      std::to_string(kMostSubSteps) +
      " are taken; choose a shorter step, coarser sampling, less damping, or tissue that is "
      "softer or heavier");
}

void SampledTissue::settle() {
  for (int k = 0; k < kMostAdaptations; ++k) {
    if (!comeToRest()) {
      throw std::runtime_error("no equilibrium under gravity: it is too soft or too heavy");
    }
    if (!body_.adapt()) break;
  }
  body_.v.setZero();
  body_.save(&settled_);
}

// All motion is stopped whenever it begins to lose energy.
bool SampledTissue::comeToRest() {
  body_.v.setZero();
  Vec3 anchors;
  const double h = kSafety * body_.longestSteps().minCoeff();
  double kinetic = 0.0;
  for (int k = 0; k < kMostSettlingSteps; ++k) {
    body_.umbrella().forces(body_.d, &forces_, &anchors);
    forces_ += gravity_ * body_.masses.transpose();
    if (forces_.norm() <= 0.01 * tolerance_) return true;
    body_.v += h * forces_ * body_.masses.cwiseInverse().asDiagonal();
    const double now = body_.v.colwise().squaredNorm().dot(body_.masses.transpose());
    if (now < kinetic) body_.v.setZero();
    kinetic = now < kinetic ? 0.0 : now;
    body_.d += h * body_.v;
  }
  return false;
}

// How many sub-steps; 0: too many.
int SampledTissue::planSteps(double dt) {
  double shortest = stableStep();
  if (most_change_ > 0.0) {
    Vec3 anchors;
    body_.umbrella().forces(body_.d, &forces_, &anchors);
    forces_ += gravity_ * body_.masses.transpose();
    double most = 0.0;
    for (Eigen::Index i = 0; i < forces_.cols(); ++i) {
      most = std::max(most, forces_.col(i).norm() / body_.masses[i]);
    }
    if (most * shortest > most_change_) shortest = most_change_ / most;
  }
  const double wanted = std::max(1.0, std::ceil(dt / shortest));
  return wanted <= kMostSubSteps ? static_cast<int>(wanted) : 0;
}

// Whether contact did not throw anything.
bool SampledTissue::subStep(double h, double s) {
  touch_.sweep.beginStep(x_);
  touch_.sweep.place(s);
  if (!touch_.sweep.candidatesHold(x_)) touch_.sweep.search(x_);
  forces_ = gravity_ * body_.masses.transpose();
  if (touch_.contact.hasCandidates()) {
    on_surface_.setZero();
    touch_.contact.addGradient(x_, &on_surface_);
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
  touch_.contact.endStep(x_);
  return true;
}

const TissueStep& SampledTissue::step(const std::vector<contact::Obstacle>& obstacles, double dt) {
  out_.clear();
  touch_.begin(obstacles, x_, surface_v_, dt, &out_);
  if (rest_.sleeps(touch_)) {
    rest_.report(&out_);
    return out_;
  }
  rest_.begin(x_);
  before_.clear();
  body_.save(&before_);
  touch_.sweep.place(0.0);
  out_.tolerance = tolerance_;
  const int steps = planSteps(dt);
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
    touch_.sides.doubt();
    touch_.contact.forget();
    follow();
    out_.recover(Recovery::kRolledBack);
    out_.status = steps == 0     ? solver::SolveStatus::kIterationLimit
                  : done < steps ? solver::SolveStatus::kLineSearchFailed
                                 : solver::SolveStatus::kNonFinite;
    return out_;
  }
  body_.surface().interpolate(body_.v, &surface_v_);
  if (late) {  // where the tools are now the tissue has not followed them
    touch_.sides.doubt();
    out_.status = solver::SolveStatus::kDeadline;
  } else {
    touch_.contact.learn(x_, dt);
  }
  report();
  if (rest_.sleeps(touch_)) {
    endAtRest();
  } else if (body_.adapt()) {
    follow();
  }
  return out_;
}

// What it parted it joins only where that makes a difference of less than `coarsen_below`. But a
// linear body has one rest: untouched, it ends there.
void SampledTissue::endAtRest() {
  const Points x = x_;
  StateWriter parted;
  body_.save(&parted);
  StateReader settled(settled_.bytes());
  body_.restore(&settled);
  body_.v.setZero();
  follow();
  if ((x_ - x).cwiseAbs().maxCoeff() <= kSameRest * size_) return;
  StateReader back(parted.bytes());
  body_.restore(&back);
  follow();
}

void SampledTissue::report() {
  Vec3 support;
  body_.umbrella().forces(body_.d, &forces_, &support);
  forces_ += gravity_ * body_.masses.transpose();
  out_.elastic_energy = body_.umbrella().energy(body_.d);
  out_.kinetic_energy = 0.5 * body_.v.colwise().squaredNorm().dot(body_.masses.transpose());
  if (rest_.isStill(x_, touch_, out_) && forces_.norm() <= tolerance_) {
    rest_.fallAsleep();
    body_.v.setZero();
    surface_v_.setZero();
  }
  out_.support_force = -support;
  out_.gravity_force = gravity_ * body_.masses.sum();
  touch_.report(x_, &out_);
  out_.inertia_force = -forces_.rowwise().sum();
  for (const TissueContact& c : out_.contacts) out_.inertia_force += c.force_W;
  touch_.countInactive(&out_);
  rest_.remember(out_);
}

void SampledTissue::place(int, const Points& positions, const Points& velocities) {
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

}  // namespace

std::unique_ptr<TissueModel> makeSampledElasticity(const ModelDescription& description) {
  const OrganDescription& organ = description.organs.front();
  if (organ.adapt.on()) {
    throw std::invalid_argument(
        "adapt: particles of model sampled_elasticity are parted as `sampling` says; leave it out");
  }
  mesh::TetMesh mesh = organ.tetrahedra();
  const fem::FreeMask free = organ.free(mesh.points);
  const fem::Composition composition = organ.composition(mesh);
  if (composition.solids.size() > 1 || !composition.frames.empty()) {
    throw std::invalid_argument("model sampled_elasticity has one solid, without fibres");
  }
  if (!composition.solids.front().prony.empty()) {
    throw std::invalid_argument(
        "model sampled_elasticity has no viscous memory; leave viscoelastic out");
  }
  mesh.points = (organ.X_WO * mesh.points.colwise().homogeneous()).eval();
  const std::string motions = fem::freeRigidMotions(mesh.points, free);
  if (!motions.empty() && !description.settings.gravity.isZero()) {
    throw std::invalid_argument("gravity would move the organ, its supports leave " + motions);
  }
  // No stiffer than rest needs, for it bounds the step; what is entered meanwhile, multipliers
  // learn.
  ModelSettings settings = description.settings;
  const material::Solid& solid = composition.solids.front();
  settings.contact.stiffness =
      std::min(settings.contact.stiffness,
               kContact * material::moduli(solid.law).mu / finestOf(organ.sampling));
  return std::make_unique<SampledTissue>(mesh, free, solid, organ, settings);
}

}  // namespace palpate::tissue
