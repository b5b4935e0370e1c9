// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool_contact.h"

#include <utility>

namespace palpate::tissue {

ToolContact::ToolContact(const Points& X, const Eigen::Matrix3Xi& triangles,
                         const ModelSettings& settings, int organ,
                         std::function<double(double)> excess, const Eigen::Matrix4Xi& tets,
                         double thickness, const std::vector<contact::SurfaceSample>& samples)
    : contact(samples.empty()
                  ? contact::sampleSurface(X, triangles, settings.sample_spacing.instruments)
                  : samples,
              contact::makeResponse(settings.contact, settings.responses)),
      tool_path(&contact, (X.rowwise().maxCoeff() - X.rowwise().minCoeff()).norm(),
                settings.skip.far_tools),
      needles(X, tets, settings.contact.stiffness),
      triangles_(triangles),
      has_inside_(thickness == 0.0),
      organ_(organ),
      excess_(std::move(excess)),
      skip_inactive_(settings.skip.inactive_samples) {
  const contact::SampleSpacing& spacing = settings.sample_spacing;
  if (samples.empty() && spacing.anatomy > 0.0)
    contact.addAnatomySamples(X, triangles, spacing.anatomy);
  if (has_inside_ && samples.empty()) contact.addFaceContact(X, triangles, spacing.instruments);
  contact.setThickness(thickness);
  contact.setSkips(settings.skip.distant_samples, settings.skip.inactive_samples);
}

void ToolContact::begin(const std::vector<contact::Obstacle>& obstacles, const Points& x,
                        const Points& v, double dt, TissueStep* out) {
  const PhaseTimer timer(&out->phases, Phase::kContact);
  const double way = dt * v.colwise().norm().maxCoeff();
  out->far_bodies = tool_path.begin(obstacles, x, way);
  needles.begin(tool_path.near(), x);
  tool_path.leaveOut(needles.inside());
  if (has_inside_) inside_tools.update(tool_path.near(), x, triangles_);
  tool_path.leaveOut(inside_tools.inside());
  out->tools_inside = static_cast<int>(inside_tools.inside().size());
  moveTo(1.0);
  tool_path.search(x);
  out->distant_samples = contact.numDistant();
}

void ToolContact::moveTo(double s) {
  tool_path.moveTo(s);
  needles.moveTo(s);
}

void ToolContact::endStep(const Points& x) {
  contact.endStep(x);
  needles.endStep(x);
}

void ToolContact::save(StateWriter* to) const {
  contact.save(to);
  inside_tools.save(to);
  needles.save(to);
}

void ToolContact::restore(StateReader* from) {
  contact.restore(from);
  inside_tools.restore(from);
  needles.restore(from);
}

void ToolContact::forget() {
  tool_path.clear();
  contact.forget();
  inside_tools.forget();
  needles.forget();
}

void ToolContact::goOnFrom(const ToolContact& old, const Points& X, const Points& old_X) {
  contact.forget();
  contact.goOnFrom(old.contact, X, old_X);
  inside_tools = old.inside_tools;
  needles.goOnFrom(old.needles);
}

bool ToolContact::possibleByTools() const {
  if (!needles.inside().empty()) return true;
  for (int k = 0; k < contact.numObstacles(); ++k) {
    if (tool_path.owner(k).isInstrument() && contact.hasCandidates(k)) return true;
  }
  return false;
}

double ToolContact::report(const Points& x, TissueStep* out) {
  const PhaseTimer timer(&out->phases, Phase::kContact);
  contact.collectAtEnd(x, &contacts_);
  nodal_.setZero(3, x.cols());
  too_much_.clear();
  for (const contact::Contact& c : contacts_) {
    const contact::Touch& touch = c.touch;
    out->contacts.push_back(
        {tool_path.owner(touch.obstacle), touch.penetration(), touch.p_W, c.force_W, organ_});
    out->frictionless_touches += contact.rubs(c) ? 0 : 1;
    for (int k = 0; k < 3; ++k) nodal_.col(touch.nodes[k]) += touch.weights[k] * c.force_W;
    if (!excess_ || !tool_path.owner(touch.obstacle).isInstrument()) continue;
    const auto owner = static_cast<std::size_t>(tool_path.owner(touch.obstacle).index);
    if (too_much_.size() <= owner) too_much_.resize(owner + 1, Vec3::Zero());
    // Present edge length: a surface stretched around a tool is coarser than at rest.
    const double excess = excess_(touch.meanEdge(x) / touch.radius);
    too_much_[owner] += excess / (1.0 + excess) * c.force_W;
  }
  needles.forPulls([&](const contact::Owner& owner, const contact::NeedleChannel::Pull& pull) {
    out->contacts.push_back({owner, 0.0, pull.p_W, pull.force_W, organ_});
    for (int k = 0; k < 4; ++k) {
      nodal_.col(pull.place.nodes[k]) += pull.place.weights[k] * pull.force_W;
    }
  });
  needles.puncture(tool_path.near(), contacts_, x);
  for (const Vec3& force : too_much_) out->mesh_error += force.norm();
  return nodal_.norm();
}

void ToolContact::countInactive(TissueStep* out) const {
  if (!skip_inactive_) return;
  out->inactive_samples = contact.numCandidates() - static_cast<int>(out->contacts.size());
}

}  // namespace palpate::tissue
