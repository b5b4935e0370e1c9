// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "palpate/fem/elastic_energy.h"
#include "palpate/fem/energy_term.h"
#include "palpate/fem/supports.h"

namespace palpate::solver {

/// What a solve minimises: s W(x) plus terms, over the free components of x.
struct Potential {
  fem::ElasticEnergy* elasticity;
  std::vector<const fem::EnergyTerm*> terms;
  fem::FreeMask free;          ///< 3 x n
  double elastic_scale = 1.0;  ///< s; damping in proportion to stiffness enlarges it.

  double value(const Points& x) const {
    double sum = elastic_scale * elasticity->energy(x);
    for (const fem::EnergyTerm* term : terms) sum += term->value(x);
    return sum;
  }
  /// All components, the held ones too: there it is minus the support's force on the body.
  double gradient(const Points& x, Points* g) const {
    double sum = elastic_scale * elasticity->gradient(x, g);
    if (elastic_scale != 1.0) *g *= elastic_scale;
    for (const fem::EnergyTerm* term : terms) sum += term->addGradient(x, g);
    return sum;
  }
  void hessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const {
    elasticity->hessian(x, tangent, K);
    if (elastic_scale != 1.0) K->scale(elastic_scale);
    K->forgetAdded();
    addTermHessians(x, tangent, K);
  }
  void addTermHessians(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const {
    for (const fem::EnergyTerm* term : terms) term->addHessian(x, tangent, K);
  }
  double maxStep(const Points& x, const Points& d) const {
    double largest = 1.0;
    for (const fem::EnergyTerm* term : terms) largest = std::min(largest, term->maxStep(x, d));
    return largest;
  }
  bool conservative() const {
    for (const fem::EnergyTerm* term : terms) {
      if (!term->conservative()) return false;
    }
    return true;
  }
};

}  // namespace palpate::solver
