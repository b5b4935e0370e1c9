// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/fem/elastic_energy.h"

namespace palpate::fem {

/// The elastic energies of several bodies as that of one, sum_k s_k W_k(x_k), over their points one
/// body after another. The matrix has the bodies' patterns along its diagonal and nothing between
/// them: what acts between bodies becomes couplings.
class JointEnergy final : public ElasticEnergy {
 public:
  /// They must outlive this.
  explicit JointEnergy(const std::vector<ElasticEnergy*>& bodies);

  /// s of body k, 1 at first: damping in proportion to stiffness enlarges it.
  void setScale(std::size_t k, double scale) { bodies_[k].scale = scale; }
  int numNodes() const { return num_nodes_; }
  /// The first node of body k.
  int firstNode(std::size_t k) const { return bodies_[k].first_node; }

  Stiffness makeMatrix() const override;
  double energy(const Points& x) override;
  double gradient(const Points& x, Points* g) override;
  void hessian(const Points& x, Tangent tangent, Stiffness* K) override;
  bool viscous() const override;

 private:
  struct Body {
    ElasticEnergy* energy;
    double scale;
    int first_node;
    Stiffness K;
    Points x, g;
  };
  static void take(const Points& x, Body* body) {
    body->x = x.middleCols(body->first_node, body->K.numNodes());
  }

  std::vector<Body> bodies_;
  int num_nodes_ = 0;
};

}  // namespace palpate::fem
