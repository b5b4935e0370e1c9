// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/fem/elastic_energy.h"

namespace palpate::fem {

/// Sum of the elastic energies of several bodies, sum_k s_k W_k(x_k), over their concatenated
/// nodes. The matrix is block-diagonal; interactions between bodies become couplings.
class JointEnergy final : public ElasticEnergy {
 public:
  /// The bodies must outlive this.
  explicit JointEnergy(const std::vector<ElasticEnergy*>& bodies);

  /// Sets s_k of body k, initially 1; stiffness-proportional damping enlarges s_k.
  void setScale(std::size_t k, double scale) { bodies_[k].scale = scale; }
  int numNodes() const { return num_nodes_; }
  /// First node of body k.
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
