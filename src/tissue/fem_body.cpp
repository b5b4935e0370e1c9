// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem_body.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "palpate/solver/static_solver.h"

namespace palpate::tissue {
namespace {

int numInviscid(const fem::Composition& composition) {
  return static_cast<int>(std::count_if(composition.solids.begin(), composition.solids.end(),
                                        [](const material::Solid& s) { return s.prony.empty(); }));
}

double largestPoissonRatio(const fem::Composition& composition) {
  double largest = -1.0;
  for (const material::Solid& solid : composition.solids) {
    const material::Moduli m = material::moduli(solid.law);
    largest = std::max(largest, (3.0 * m.kappa - 2.0 * m.mu) / (6.0 * m.kappa + 2.0 * m.mu));
  }
  return largest;
}

// Has solids without viscous terms treated as if they had some, of no strength to speak of.
fem::Composition withViscousTerms(fem::Composition composition) {
  for (material::Solid& solid : composition.solids) {
    if (!solid.prony.empty()) continue;
    const std::vector<material::PronyTerm> feeble = {{1e-12, 1.0}};
    try {
      material::checkProny(solid.law, feeble);
      solid.prony = feeble;
    } catch (const std::invalid_argument&) {  // a law that cannot relax
    }
  }
  return composition;
}

}  // namespace

FemBody::FemBody(const mesh::TetMesh& tet_mesh, const fem::Composition& composition,
                 fem::FreeMask free_mask, const FemSettings& fem_settings, ThreadPool* thread_pool)
    : settings(fem_settings),
      mesh(tet_mesh),
      free(std::move(free_mask)),
      pool(thread_pool),
      size((mesh.points.rowwise().maxCoeff() - mesh.points.rowwise().minCoeff()).norm()),
      triangles(mesh::trianglesOf(mesh::boundaryFaces(mesh))),
      elasticity(fem::makeElasticity(
          settings.element, mesh,
          settings.skip.viscous_terms ? composition : withViscousTerms(composition), pool)),
      gravity(settings.gravity * elasticity->loadWeights().transpose()),
      contact(contact::sampleSurface(mesh.points, triangles, settings.sample_spacing),
              contact::makeResponse(settings.contact, settings.responses)),
      sweep(&contact, size, settings.skip.far_tools),
      largest_poisson_ratio(largestPoissonRatio(composition)),
      inviscid_solids(settings.skip.viscous_terms ? numInviscid(composition) : 0),
      x(mesh.points),
      v(Points::Zero(3, mesh.numPoints())) {
  contact.setSkips(settings.skip.distant_samples, settings.skip.inactive_samples);
  weight = gravity.forces().rowwise().sum();
  weight_norm_ = gravity.forces().norm();
  const double element_area =
      std::pow(elasticity->volume() / static_cast<double>(mesh.numPoints()), 2.0 / 3.0);
  force_floor = 0.1 * composition.softestShearModulus() * element_area;
  // Forces left on the nodes accelerate them by no more than would move them by the tolerance in
  // the time that a shear wave takes through the body; after that, elasticity holds them.
  const double volume = elasticity->volume(), mass = elasticity->masses().sum();
  const double wave_speed_squared = composition.softestShearModulus() * volume / mass;
  const double time_squared = std::pow(volume, 2.0 / 3.0) / wave_speed_squared;
  least_force_ = settings.position_tolerance * elasticity->masses().norm() / time_squared;
}

double FemBody::tolerance() const {
  const double forces = std::max({weight_norm_, contact_force, support_force});
  return std::max(settings.tolerance * forces, least_force_);
}

void FemBody::reportContacts(TissueStep* out) {
  const PhaseTimer timer(&out->phases, Phase::kContact);
  contact.collect(x, &contacts_);
  nodal_.setZero(3, x.cols());
  for (const contact::Contact& c : contacts_) {
    const contact::Touch& touch = c.touch;
    out->contacts.push_back(
        {sweep.owner(touch.obstacle), touch.penetration(), touch.p_W, c.force_W});
    const contact::SurfaceSample& s = contact.samples()[touch.sample];
    for (int k = 0; k < 3; ++k) nodal_.col(s.nodes[k]) += s.weights[k] * c.force_W;
  }
  contact_force = nodal_.norm();
}

void FemBody::reportSupport(const Points& gradient, TissueStep* out) {
  nodal_ = gradient.array() * (1.0 - free.array());
  out->support_force = nodal_.rowwise().sum();
  support_force = nodal_.norm();
}

Points settleUnderGravity(FemBody* body) {
  Points settled = body->mesh.points;
  if (body->settings.gravity.isZero()) return settled;
  const std::string motions = fem::freeRigidMotions(body->mesh.points, body->free);
  if (!motions.empty()) {
    throw std::invalid_argument("gravity would move the body, its supports leave " + motions +
                                "; hold more of it or set gravity to zero");
  }
  const solver::Potential statics{body->elasticity.get(), {&body->gravity}, body->free, 1.0};
  solver::StaticSettings static_settings;
  static_settings.tolerance = 1e-8;
  const solver::StaticReport report = solver::solveStatic(
      statics,
      [&](double s) {
        body->gravity.setFactor(s);
        return body->mesh.points;
      },
      static_settings, &settled);
  body->gravity.setFactor(1.0);
  const bool turned_over = body->elasticity->minJacobian(settled) <= 0.0;
  if (report.status != solver::SolveStatus::kConverged || turned_over) {
    throw std::runtime_error("no equilibrium under gravity: the body collapses at " +
                             std::to_string(report.load_factor) +
                             " of its weight; is it too soft or too heavy?");
  }
  return settled;
}

}  // namespace palpate::tissue
