// SPDX-License-Identifier: GPL-3.0-or-later
#include "rest_matrix.h"

#include <limits>

#include "palpate/solver/integrator.h"
#include "palpate/solver/potential.h"

namespace palpate::tissue {

void assembleAtRest(FemBody* body, fem::Stiffness* A) {
  const FemSettings& settings = body->settings;
  const Points& X = body->mesh.points;
  solver::Integrator integrator(settings.integrator, body->elasticity->masses(),
                                {settings.mass_damping, settings.stiffness_damping});
  solver::Potential potential{body->elasticity.get(), {}, body->free};
  integrator.addTerms(&potential);
  for (const fem::EnergyTerm* term : body->surroundings.terms()) potential.terms.push_back(term);
  integrator.start(X, Points::Zero(3, X.cols()));
  if (integrator.needsElasticGradient()) {
    Points g;
    body->elasticity->gradient(X, &g);
    integrator.setElasticGradient(g);
  }
  integrator.beginStep(settings.step, &potential);
  body->elasticity->beginStep(settings.step);
  potential.hessian(X, fem::Tangent::kConvexTerms, A);
  A->constrain(body->free);
  body->elasticity->beginStep(std::numeric_limits<double>::infinity());
}

}  // namespace palpate::tissue
