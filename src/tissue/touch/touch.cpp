// SPDX-License-Identifier: GPL-3.0-or-later
#include "touch.h"

namespace palpate::tissue {

Touch::Touch(const Points& X, const Eigen::Matrix3Xi& triangles, const ModelSettings& settings,
             int organ)
    : contact(contact::sampleSurface(X, triangles, settings.sample_spacing),
              contact::makeResponse(settings.contact, settings.responses)),
      sweep(&contact, (X.rowwise().maxCoeff() - X.rowwise().minCoeff()).norm(),
            settings.skip.far_tools),
      organ_(organ),
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

double Touch::report(const Points& x, TissueStep* out) {
  const PhaseTimer timer(&out->phases, Phase::kContact);
  contact.collectAtEnd(x, &contacts_);
  nodal_.setZero(3, x.cols());
  for (const contact::Contact& c : contacts_) {
    const contact::Touch& touch = c.touch;
    out->contacts.push_back(
        {sweep.owner(touch.obstacle), touch.penetration(), touch.p_W, c.force_W, organ_});
    const contact::SurfaceSample& s = contact.samples()[touch.sample];
    for (int k = 0; k < 3; ++k) nodal_.col(s.nodes[k]) += s.weights[k] * c.force_W;
  }
  return nodal_.norm();
}

void Touch::countInactive(TissueStep* out) const {
  if (!skip_inactive_) return;
  out->inactive_samples = contact.numCandidates() - static_cast<int>(out->contacts.size());
}

}  // namespace palpate::tissue
