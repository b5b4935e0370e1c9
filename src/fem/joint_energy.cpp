// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/fem/joint_energy.h"

#include <algorithm>
#include <cmath>

namespace palpate::fem {

JointEnergy::JointEnergy(const std::vector<ElasticEnergy*>& bodies) {
  for (ElasticEnergy* energy : bodies) {
    bodies_.push_back({energy, 1.0, num_nodes_, energy->makeMatrix(), {}, {}});
    num_nodes_ += bodies_.back().K.numNodes();
  }
}

Stiffness JointEnergy::makeMatrix() const {
  std::vector<const Stiffness*> parts;
  parts.reserve(bodies_.size());
  for (const Body& body : bodies_) parts.push_back(&body.K);
  return Stiffness::sideBySide(parts);
}

double JointEnergy::energy(const Points& x) {
  double sum = 0.0;
  for (Body& body : bodies_) {
    take(x, &body);
    sum += body.scale * body.energy->energy(body.x);
  }
  return sum;
}

double JointEnergy::gradient(const Points& x, Points* g) {
  g->resize(3, num_nodes_);
  double sum = 0.0;
  for (Body& body : bodies_) {
    take(x, &body);
    sum += body.scale * body.energy->gradient(body.x, &body.g);
    g->middleCols(body.first_node, body.K.numNodes()) = body.scale * body.g;
  }
  return sum;
}

// For nodal pressures, rows scaled by sqrt(s) give s B^T M B, so one factorisation serves all
// bodies.
void JointEnergy::hessian(const Points& x, Tangent tangent, Stiffness* K) {
  double* to = K->blocks().values();
  Eigen::Index first_entry = 0;
  for (Body& body : bodies_) {
    take(x, &body);
    body.energy->hessian(body.x, tangent, &body.K);
    const double* from = body.K.blocks().values();
    const double scale = body.scale;
    to = std::transform(from, from + 9 * static_cast<std::ptrdiff_t>(body.K.blocks().numBlocks()),
                        to, [scale](double value) { return scale * value; });
    if (!body.K.hasVolume()) continue;
    const VolumeStiffness& volume = body.K.volume();
    K->volume().rows.middleCols(first_entry, volume.rows.cols()) =
        std::sqrt(scale * volume.factor) * volume.rows;
    first_entry += volume.rows.cols();
  }
  if (K->hasVolume()) K->volume().factor = 1.0;
}

bool JointEnergy::viscous() const {
  return std::any_of(bodies_.begin(), bodies_.end(),
                     [](const Body& body) { return body.energy->viscous(); });
}

}  // namespace palpate::fem
