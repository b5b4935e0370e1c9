// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem_body.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bearing_stiffness.h"
#include "palpate/contact/contact_models.h"
#include "palpate/solver/static_solver.h"
#include "palpate/tissue/fem/force_excess.h"

namespace palpate::tissue {
namespace {

int numInviscid(const fem::Composition& composition) {
  return static_cast<int>(std::count_if(composition.solids.begin(), composition.solids.end(),
                                        [](const material::Solid& s) { return s.prony.empty(); }));
}

// Strength of the inversion barrier over the pressure that flattens a solid [-].
constexpr double kGuard = 10.0;

// Largest P-wave modulus of any solid at rest [Pa].
double stiffestModulus(const fem::Composition& composition) {
  double stiffest = 0.0;
  for (const material::Solid& solid : composition.solids) {
    const material::Moduli m = material::moduli(solid.law);
    stiffest = std::max(stiffest, m.kappa + 4.0 / 3.0 * m.mu);
  }
  return stiffest;
}

double largestPoissonRatio(const fem::Composition& composition) {
  double largest = -1.0;
  for (const material::Solid& solid : composition.solids) {
    const material::Moduli m = material::moduli(solid.law);
    largest = std::max(largest, (3.0 * m.kappa - 2.0 * m.mu) / (6.0 * m.kappa + 2.0 * m.mu));
  }
  return largest;
}

// Gives solids without viscous terms negligible ones, to measure the cost of skip.viscous_terms.
fem::Composition withViscousTerms(fem::Composition composition) {
  for (material::Solid& solid : composition.solids) {
    if (!solid.prony.empty()) continue;
    const std::vector<material::PronyTerm> feeble = {{1e-12, 1.0}};
    try {
      material::checkProny(solid.law, feeble);
      solid.prony = feeble;
    } catch (const std::invalid_argument&) {  // law without relaxation
    }
  }
  return composition;
}

// Sample spacing of prescribed contact over the body's size [-].
constexpr double kPrescribedSpacing = 0.02;

// Prescribed contact uses no response, and samples only to find near tools.
ModelSettings touchSettings(const FemSettings& settings, double size) {
  ModelSettings touch = settings;
  if (!contact::isPrescribed(settings.contact)) return touch;
  touch.contact.model = touch.responses.front().name;
  touch.sample_spacing = kPrescribedSpacing * size;
  return touch;
}

// See ToolContact. Quadratic faces are four triangles of half their edges.
std::function<double(double)> excessOf(const std::string& element) {
  if (!forceExcess(element, 1.0)) return {};
  const double edges = fem::isQuadratic(element) ? 2.0 : 1.0;
  return [element, edges](double ratio) { return *forceExcess(element, edges * ratio); };
}

}  // namespace

FemBody::FemBody(const mesh::TetMesh& tet_mesh, const fem::Composition& composition,
                 const Surroundings& what_surrounds, const FemSettings& fem_settings,
                 ThreadPool* thread_pool, Drive what_drives,
                 std::shared_ptr<fem::Elasticity> own_elasticity, const Eigen::Matrix3Xi& surface,
                 const std::vector<contact::SurfaceSample>& samples)
    : settings(fem_settings),
      mesh(tet_mesh),
      free(what_surrounds.free),
      pool(thread_pool),
      size((mesh.points.rowwise().maxCoeff() - mesh.points.rowwise().minCoeff()).norm()),
      solid_of(composition.solid_of),
      triangles(surface.cols() > 0 ? surface : mesh::trianglesOf(mesh::boundaryFaces(mesh))),
      elasticity(own_elasticity ? std::move(own_elasticity)
                                : fem::makeElasticity(settings.element, mesh,
                                                      settings.skip.viscous_terms
                                                          ? composition
                                                          : withViscousTerms(composition),
                                                      pool)),
      guard(mesh, kGuard * stiffestModulus(composition)),
      drive(std::move(what_drives)),
      gravity(settings.gravity * elasticity->loadWeights().transpose()),
      surroundings(what_surrounds, mesh),
      tool_contact(mesh.points, triangles, touchSettings(settings, size), 0,
                   excessOf(settings.element), mesh.tets, settings.thickness, samples),
      contact(tool_contact.contact),
      tool_path(tool_contact.tool_path),
      largest_poisson_ratio(largestPoissonRatio(composition)),
      inviscid_solids(settings.skip.viscous_terms ? numInviscid(composition) : 0),
      x(mesh.points),
      v(Points::Zero(3, mesh.numPoints())),
      around_(surroundings.terms()) {
  contact.setBearing(free, elasticity->masses(), bearingStiffness(mesh, triangles, composition));
  weight = gravity.forces().rowwise().sum();
  weight_norm_ = gravity.forces().norm() + drive.load_norm;
  support_forces.setZero(3, mesh.numPoints());
  const double element_area =
      std::pow(elasticity->volume() / static_cast<double>(mesh.numPoints()), 2.0 / 3.0);
  force_floor = 0.1 * composition.softestShearModulus() * element_area;
  // The residual moves nodes by at most position_tolerance within the time of a shear wave through
  // the body.
  const double volume = elasticity->volume(), mass = elasticity->masses().sum();
  const double wave_speed_squared = composition.softestShearModulus() * volume / mass;
  const double time_squared = std::pow(volume, 2.0 / 3.0) / wave_speed_squared;
  least_force_ = settings.position_tolerance * elasticity->masses().norm() / time_squared;
  // Without position_tolerance: relative to a small strain of one element.
  if (settings.position_tolerance == 0.0) least_force_ = settings.tolerance * force_floor;
}

void FemBody::moveTo(const Points& positions, const Points& velocities) {
  x = positions;
  v = velocities;
  elastic_energy.reset();
  min_jacobian.reset();
}

void FemBody::startAt(const Points& positions, const Points& velocities) {
  moveTo(positions, velocities);
  elasticity->relax(x);
  tool_contact.forget();
  guard.setActive(false);
  contact_force = support_force = 0.0;
}

double FemBody::leastTolerance() const {
  return std::max(settings.tolerance * weight_norm_, least_force_);
}

double FemBody::tolerance() const { return toleranceFor(contact_force, support_force); }

double FemBody::toleranceFor(double touching, double support) const {
  return std::max(settings.tolerance * std::max(touching, support), leastTolerance());
}

double FemBody::toleranceHere(const Points& gradient, double others) {
  nodal_.setZero(3, x.cols());
  contact.addGradient(x, &nodal_);
  tool_contact.needles.addGradient(x, &nodal_);
  const double touching = std::hypot(nodal_.norm(), others);
  findSupport(gradient, &nodal_);
  return toleranceFor(touching, nodal_.norm());
}

mesh::CellMesh FemBody::cells() const {
  mesh::CellMesh cells = mesh::cellsOf(mesh);
  cells.solid = solid_of;
  return cells;
}

void FemBody::reportContacts(TissueStep* out) { contact_force = tool_contact.report(x, out); }

double FemBody::addLoads(const Points& at, Points* g) const {
  double sum = gravity.addGradient(at, g);
  for (const fem::EnergyTerm* load : drive.loads) sum += load->addGradient(at, g);
  for (const fem::EnergyTerm* term : around_) sum += term->addGradient(at, g);
  return sum;
}

bool FemBody::heldWay(double s, Points* way) const {
  if (!heldMoves()) return false;
  if (drive.held) {
    *way = (drive.held(s) - x).array() * (1.0 - free.array());
  } else {
    surroundings.carry(s, x, way);
  }
  return !way->isZero(0.0);
}

// Forces of supports and other boundary conditions at x.
void FemBody::findSupport(const Points& gradient, Points* forces) {
  *forces = gradient.array() * (1.0 - free.array());
  if (around_.empty()) return;
  around_gradient_.setZero(3, x.cols());
  for (const fem::EnergyTerm* term : around_) term->addGradient(x, &around_gradient_);
  *forces -= around_gradient_;
}

void FemBody::reportSupport(const Points& gradient, TissueStep* out) {
  findSupport(gradient, &support_forces);
  out->support_force = support_forces.rowwise().sum();
  out->cavity_pressure = surroundings.largestPressure(x);
  support_force = support_forces.norm();
}

void FemBody::goOnFrom(const FemBody& old, const mesh::MeshChange& change) {
  x = change.interpolate(old.x);
  v = change.transport(old.v, old.elasticity->lumpedMasses(), elasticity->lumpedMasses()).array() *
      surroundings.movable(free).array();
  surroundings.goOnFrom(old.surroundings);
  elasticity->goOnFrom(*old.elasticity, change);
  tool_contact.goOnFrom(old.tool_contact, mesh.points, old.mesh.points);
  guard.setActive(old.guard.active());
  elastic_energy.reset();
  contact_force = old.contact_force;
  support_force = old.support_force;
  interrupt = old.interrupt;
}

void FemBody::save(StateWriter* out) const {
  out->put(x);
  out->put(v);
  elasticity->save(out);
  tool_contact.save(out);
  out->put(elastic_energy.has_value());
  if (elastic_energy) out->put(*elastic_energy);
  out->put(contact_force);
  out->put(support_force);
  surroundings.save(out);
  out->put(guard.active());
}

void FemBody::restore(StateReader* in) {
  in->getSame(&x);
  in->getSame(&v);
  if (!x.allFinite() || !v.allFinite()) throw std::invalid_argument("the state is not finite");
  elasticity->restore(in);
  tool_contact.restore(in);
  bool known = false;
  in->get(&known);
  elastic_energy.reset();
  if (known) in->get(&elastic_energy.emplace());
  in->get(&contact_force);
  in->get(&support_force);
  surroundings.restore(in);
  bool guarded = false;
  in->get(&guarded);
  guard.setActive(guarded);
}

Points equilibriumUnderLoads(FemBody* body) {
  Points equilibrium = body->mesh.points;
  if (body->settings.gravity.isZero() && !body->surroundings.actsAtRest()) return equilibrium;
  const std::string motions =
      fem::freeRigidMotions(body->mesh.points, body->free, body->surroundings.heldDirections());
  if (!motions.empty()) {
    const std::string load = body->settings.gravity.isZero() ? "pressure" : "gravity";
    throw std::invalid_argument(load + " would move the body, its supports leave " + motions +
                                "; hold more of it or set " + load + " to zero");
  }
  solver::Potential statics{body->elasticity.get(), {&body->gravity}, body->free, 1.0};
  for (const fem::EnergyTerm* term : body->surroundings.terms()) statics.terms.push_back(term);
  solver::StaticSettings static_settings;
  static_settings.tolerance = 1e-8;
  const solver::StaticReport report = solver::solveStatic(
      statics,
      [&](double s) {
        body->gravity.setFactor(s);
        body->surroundings.setFactor(s);
        return body->mesh.points;
      },
      static_settings, &equilibrium);
  body->gravity.setFactor(1.0);
  body->surroundings.setFactor(1.0);
  const bool turned_over = body->elasticity->minJacobian(equilibrium) <= 0.0;
  if (report.status != solver::SolveStatus::kConverged || turned_over) {
    const bool presses = body->surroundings.actsAtRest();
    throw std::runtime_error(
        std::string("no equilibrium under gravity") +
        (presses ? " and pressure: the body bursts or collapses at " : ": the body collapses at ") +
        std::to_string(report.load_factor) +
        (presses ? " of both; is it too soft, or the pressure too high?"
                 : " of its weight; is it too soft or too heavy?"));
  }
  return equilibrium;
}

}  // namespace palpate::tissue
