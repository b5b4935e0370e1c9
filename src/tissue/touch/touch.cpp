// SPDX-License-Identifier: GPL-3.0-or-later
#include "touch.h"

#include <utility>

namespace palpate::tissue {

Touch::Touch(const Points& X, const Eigen::Matrix3Xi& triangles, const ModelSettings& settings,
             int organ, std::function<double(double)> excess)
    : contact(contact::sampleSurface(X, triangles, settings.sample_spacing),
              contact::makeResponse(settings.contact, settings.responses)),
      sweep(&contact, (X.rowwise().maxCoeff() - X.rowwise().minCoeff()).norm(),
            settings.skip.far_tools),
      organ_(organ),
      excess_(std::move(excess)),
      skip_inactive_(settings.skip.inactive_samples) {
  contact.setSkips(settings.skip.distant_samples, settings.skip.inactive_samples);
}

void Touch::begin(const std::vector<contact::Obstacle>& obstacles, const Points& x, const Points& v,
                  double dt, TissueStep* out) {
  const PhaseTimer timer(&out->phases, Phase::kContact);
  const double way = dt * v.colwise().norm().maxCoeff();
  out->far_bodies = sweep.begin(obstacles, x, way);
  sweep.place(1.0);
  sweep.search(x);
  out->distant_samples = contact.numDistant();
}

bool Touch::possibleByTools() const {
  for (int k = 0; k < contact.numObstacles(); ++k) {
    if (sweep.owner(k).isInstrument() && contact.hasCandidates(k)) return true;
  }
  return false;
}

double Touch::report(const Points& x, TissueStep* out) {
  const PhaseTimer timer(&out->phases, Phase::kContact);
  contact.collectAtEnd(x, &contacts_);
  nodal_.setZero(3, x.cols());
  too_much_.clear();
  for (const contact::Contact& c : contacts_) {
    const contact::Touch& touch = c.touch;
    out->contacts.push_back(
        {sweep.owner(touch.obstacle), touch.penetration(), touch.p_W, c.force_W, organ_});
    out->frictionless_touches += contact.rubs(c) ? 0 : 1;
    const contact::SurfaceSample& s = contact.samples()[touch.sample];
    for (int k = 0; k < 3; ++k) nodal_.col(s.nodes[k]) += s.weights[k] * c.force_W;
    if (!excess_ || !sweep.owner(touch.obstacle).isInstrument()) continue;
    const auto owner = static_cast<std::size_t>(sweep.owner(touch.obstacle).index);
    if (too_much_.size() <= owner) too_much_.resize(owner + 1, Vec3::Zero());
    // As long as it is now: where the surface is stretched around a tool it is as coarse as it
    // looks there.
    const double excess = excess_(s.meanEdge(x) / touch.radius);
    too_much_[owner] += excess / (1.0 + excess) * c.force_W;
  }
  for (const Vec3& force : too_much_) out->mesh_error += force.norm();
  return nodal_.norm();
}

void Touch::countInactive(TissueStep* out) const {
  if (!skip_inactive_) return;
  out->inactive_samples = contact.numCandidates() - static_cast<int>(out->contacts.size());
}

}  // namespace palpate::tissue
