// SPDX-License-Identifier: GPL-3.0-or-later
#include "bem_organ.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tissue/touch/stage_limits.h"

namespace palpate::tissue {
namespace {

double sizeOf(const Points& X) { return (X.rowwise().maxCoeff() - X.rowwise().minCoeff()).norm(); }

Eigen::Map<const Eigen::VectorXd> flat(const Points& field) { return {field.data(), field.size()}; }

Points columns(const Eigen::VectorXd& field) {
  return Eigen::Map<const Points>(field.data(), 3, field.size() / 3);
}

std::vector<int> placesOf(const fem::FreeMask& free) {
  std::vector<int> places;
  for (Eigen::Index i = 0; i < free.cols(); ++i) {
    places.push_back(free.col(i).isZero() ? -1 : static_cast<int>(i));
  }
  return places;
}

Eigen::Matrix3Xd supportRows(const Eigen::MatrixXd& stiffness, const fem::FreeMask& free) {
  Eigen::Matrix3Xd rows = Eigen::Matrix3Xd::Zero(3, stiffness.cols());
  for (Eigen::Index k = 0; k < free.size(); ++k) {
    if (free.data()[k] == 0.0) rows.row(k % 3) += stiffness.row(k);
  }
  return rows;
}

// Sets mass and stiffness scale of each point: mass behind its part of the surface, and Young's
// modulus over the mean edge.
void setBearing(const BemParts& parts, contact::ContactPotential* contact) {
  const Points& X = parts.surface.points;
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(X.cols()), lengths = areas, edges = areas;
  for (const auto& t : parts.surface.triangles.colwise()) {
    const Vec3 u = X.col(t[1]) - X.col(t[0]), v = X.col(t[2]) - X.col(t[0]);
    const double third = u.cross(v).norm() / 6.0;
    for (int k = 0; k < 3; ++k) {
      areas[t[k]] += third;
      edges[t[k]] += 2.0;
      const double length = (X.col(t[(k + 1) % 3]) - X.col(t[k])).norm();
      lengths[t[k]] += length;
      lengths[t[(k + 1) % 3]] += length;
    }
  }
  const material::Moduli& m = parts.moduli;
  const double young = 9.0 * m.kappa * m.mu / (3.0 * m.kappa + m.mu);
  const double mass = parts.density * mesh::enclosedVolume(parts.surface);
  contact->setBearing(parts.free, mass / areas.sum() * areas, young * edges.cwiseQuotient(lengths));
}

}  // namespace

BemOrgan::BemOrgan(const BemParts& parts, const ModelSettings& settings, ThreadPool* pool)
    : surface_(parts.surface),
      free_(parts.free),
      settings_(settings),
      stiffness_(bem::surfaceStiffness(surface_, parts.moduli, pool)),
      compliance_(bem::surfaceCompliance(stiffness_.matrix, free_, pool)),
      support_rows_(supportRows(stiffness_.matrix, free_)),
      places_(placesOf(free_)),
      loads_(bem::bodyForces(surface_, parts.moduli, stiffness_.matrix,
                             parts.density * settings.gravity)),
      u_loads_(columns(compliance_ * flat(loads_))),
      tool_contact_(surface_.points, surface_.triangles, settings),
      rest_(Rest::kMotion * sizeOf(surface_.points), settings.skip.sleeping),
      contact_(&tool_contact_.contact, surface_.points, free_, {places_, compliance_}) {
  // Least force for tolerances: moves no point farther than position_tolerance, or strains the body
  // a little.
  least_force_ =
      settings.position_tolerance > 0.0
          ? settings.position_tolerance / compliance_.diagonal().maxCoeff()
          : 0.01 * settings.tolerance * parts.moduli.mu * std::pow(sizeOf(surface_.points), 2);
  setBearing(parts, &tool_contact_.contact);
  BemOrgan::reset();
}

mesh::CellMesh BemOrgan::cells(int) const {
  mesh::CellMesh cells;
  cells.points = surface_.points;
  cells.cells = surface_.triangles;
  return cells;
}

std::vector<std::string> BemOrgan::notes() const {
  std::ostringstream text;
  text.precision(2);
  text << "model bem: " << surface_.points.cols() << " points and " << surface_.triangles.cols()
       << " triangles, linear and quasi-static: damping is not used, a part that turns is deformed "
          "by it, and only tools and anatomy touch it ("
       << 8e-6 * static_cast<double>(compliance_.size() + stiffness_.matrix.size()) << " MB)";
  return {text.str()};
}

double BemOrgan::tolerance() const {
  const double scale = std::max({loads_.norm(), contact_scale_, support_scale_});
  return std::max(settings_.tolerance * scale, least_force_);
}

const TissueStep& BemOrgan::step(const std::vector<contact::Obstacle>& obstacles, double dt) {
  out_.clear();
  tool_contact_.begin(obstacles, x_, v_, dt, &out_);
  if (rest_.sleeps(tool_contact_)) {
    rest_.report(&out_);
    return out_;
  }
  rest_.begin(x_);
  x_begin_ = x_;
  force_begin_ = force_;
  out_.tolerance = tolerance();
  solveStages();
  // Without inertia a cut cycle is rolled back.
  const bool late = out_.status == solver::SolveStatus::kDeadline;
  if (late || !x_.allFinite() || !solver::usable(out_.status)) {
    fail();
    return out_;
  }
  out_.satisfied = out_.newton_iterations == 0 && out_.ok();
  v_ = (x_ - x_begin_) / dt;
  report();
  tool_contact_.endStep(x_);
  if (out_.ok()) tool_contact_.contact.learn(x_, dt);
  contact_scale_ = tool_contact_.report(x_, &out_);
  tool_contact_.countInactive(&out_);
  rest_.remember(out_);
  return out_;
}

void BemOrgan::fail() {
  out_.recover(Recovery::kRolledBack);
  x_ = x_begin_;
  force_ = force_begin_;
  v_.setZero();
  tool_contact_.contact.forget();
  tool_contact_.inside_tools.invalidate();
  if (out_.status == solver::SolveStatus::kDeadline) return;
  if (solver::usable(out_.status)) out_.status = solver::SolveStatus::kNonFinite;
}

// Moves the tools stage by stage, and solves after each.
void BemOrgan::solveStages() {
  tool_contact_.moveTo(0.0);
  tool_contact_.tool_path.beginStep(x_);
  out_.sweep_stages = 0;
  for (double s = 0.0; s < 1.0;) {
    s = tool_contact_.tool_path.next(x_, s, 1.0);
    ++out_.sweep_stages;
    tool_contact_.moveTo(s);
    out_.status = solveStage((s < 1.0 ? kStageTolerance : 1.0) * 0.5 * out_.tolerance).status;
    if (!solver::usable(out_.status) || out_.status == solver::SolveStatus::kDeadline) return;
  }
  const int most =
      tool_contact_.contact.hasFriction() ? kMaxFrictionAugmentations : kMaxAugmentations;
  for (int k = 0; k < most && out_.ok() && !tool_contact_.contact.augmentationConverged(x_); ++k) {
    tool_contact_.contact.augment(x_);
    out_.status = solveStage(0.5 * out_.tolerance).status;
  }
}

solver::NewtonReport BemOrgan::solveStage(double tolerance) {
  const PhaseTimer timer(&out_.phases, Phase::kLinearSolve);
  solver::NewtonReport solved;
  for (int search = 0; search < kMaxSearches; ++search) {
    solved = contact_.solve(u_loads_, tolerance, settings_.max_newton_iterations, &force_, &x_,
                            interrupt_);
    out_.newton_iterations += solved.iterations;
    displace();
    if (tool_contact_.tool_path.candidatesHold(x_)) break;
    tool_contact_.tool_path.search(x_);
  }
  return solved;
}

// Computes all positions from the contact forces.
void BemOrgan::displace() {
  x_ = surface_.points + u_loads_;
  Eigen::Map<Eigen::VectorXd> x(x_.data(), x_.size());
  for (Eigen::Index i = 0; i < force_.cols(); ++i) {
    if (force_.col(i).isZero(0.0)) continue;
    x += compliance_.middleCols<3>(3 * i).lazyProduct(force_.col(i));
  }
}

void BemOrgan::report() {
  const PhaseTimer timer(&out_.phases, Phase::kForces);
  // Residual: contact forces at the present positions minus the solved ones.
  g_.setZero();
  tool_contact_.contact.addGradient(x_, &g_);
  double unbalanced = 0.0;
  Vec3 on_support = Vec3::Zero();
  for (Eigen::Index k = 0; k < g_.size(); ++k) {
    if (free_.data()[k] == 0.0) {
      on_support[k % 3] += g_.data()[k] - loads_.data()[k];
    } else {
      const double left = g_.data()[k] + force_.data()[k];
      unbalanced += left * left;
    }
  }
  g_ = x_ - surface_.points;
  out_.support_force = support_rows_.lazyProduct(flat(g_)) + on_support;
  out_.gravity_force = loads_.rowwise().sum();
  out_.elastic_energy = 0.5 * (g_.cwiseProduct(loads_).sum() + g_.cwiseProduct(force_).sum());
  out_.residual = std::sqrt(unbalanced);
  support_scale_ = out_.support_force.norm();
  if (rest_.isStill(x_, tool_contact_, out_) && out_.residual <= out_.tolerance) {
    rest_.fallAsleep();
    v_.setZero();
  }
}

void BemOrgan::reset() {
  force_.setZero(3, surface_.points.cols());
  x_ = surface_.points + u_loads_;
  v_.setZero(3, x_.cols());
  g_ = v_;
  contact_scale_ = support_scale_ = 0.0;
  tool_contact_.forget();
  rest_.wake();
}

// Contact forces become those that hold the given positions.
void BemOrgan::setPositions(int, const Points& positions, const Points& velocities) {
  x_ = positions;
  v_ = velocities;
  g_ = x_ - surface_.points;
  force_ = (columns(stiffness_.matrix * flat(g_)) - loads_).cwiseProduct(free_);
  contact_scale_ = support_scale_ = 0.0;
  tool_contact_.forget();
  rest_.wake();
}

std::string BemOrgan::kind() const {
  return "bem, " + std::to_string(surface_.points.cols()) + " points";
}

State BemOrgan::state() const {
  StateWriter out;
  out.put(x_);
  out.put(v_);
  out.put(force_);
  out.put(contact_scale_);
  out.put(support_scale_);
  tool_contact_.save(&out);
  rest_.save(&out);
  return {kind(), out.bytes()};
}

void BemOrgan::restore(const State& state) {
  checkKind(state, kind());
  StateReader in(state.bytes);
  in.getSame(&x_);
  in.getSame(&v_);
  in.getSame(&force_);
  in.get(&contact_scale_);
  in.get(&support_scale_);
  tool_contact_.restore(&in);
  rest_.restore(&in);
  in.finish();
}

}  // namespace palpate::tissue
