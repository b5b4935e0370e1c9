// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/tissue/model_description.h"
#include "palpate/tissue/tissue_model.h"
#include "sampled_body.h"
#include "tissue/touch/rest.h"

namespace palpate::tissue {

/// Model of particles with a surface and contact: makeSampledElasticity().
class SampledTissue final : public TissueModel {
 public:
  SampledTissue(const mesh::TetMesh& mesh, const fem::FreeMask& free, const material::Solid& solid,
                const OrganDescription& organ, const ModelSettings& settings)
      : X_(mesh.points),
        triangles_(mesh::trianglesOf(mesh::boundaryFaces(mesh))),
        body_(mesh, organ.X_WO, X_, heldParts(free, organ.sampling), material::moduli(solid.law),
              solid.density, organ.sampling),
        gravity_(settings.gravity),
        damping_(organ.damping.mass),
        lag_(organ.damping.stiffness),
        finest_(finestOf(organ.sampling)),
        most_change_(organ.sampling.max_velocity_change),
        step_(settings.step),
        tool_contact_(X_, triangles_, settings),
        size_((X_.rowwise().maxCoeff() - X_.rowwise().minCoeff()).norm()),
        rest_(Rest::kMotion * size_, settings.skip.sleeping),
        tolerance_(settings.tolerance * (settings.gravity.norm() * body_.masses.sum() +
                                         0.01 * material::moduli(solid.law).mu * size_ * size_) +
                   1e-9) {
    Eigen::VectorXd stiffness = Eigen::VectorXd::Zero(X_.cols());
    for (int s = 0; s < tool_contact_.contact.numForInstruments(); ++s) {
      const contact::SurfaceSample& sample = tool_contact_.contact.samples()[s];
      for (int k = 0; k < 3; ++k) {
        stiffness[sample.nodes[k]] += sample.weights[k] * sample.area * settings.contact.stiffness;
      }
    }
    body_.setContactStiffness(stiffness);
    x_ = X_;
    surface_v_ = on_surface_ = Points::Zero(3, X_.cols());
    findEquilibrium();
    SampledTissue::reset();
    refuseTooManySubSteps(settings.step);
  }

  SurfaceState surfaceState(int) const override { return {x_, surface_v_, triangles_, 0}; }
  mesh::CellMesh cells(int) const override {
    mesh::CellMesh cells;
    cells.points = X_;
    cells.cells = triangles_;
    return cells;
  }
  std::vector<std::string> notes() const override {
    std::ostringstream text;
    text.precision(3);
    text << body_.leaves().size() << " particles at rest, steps of " << stableStep()
         << " s; the published rule allows "
         << body_.umbrella().publishedStep(body_.tree().particles().front().size) << " s";
    return {text.str()};
  }
  void setInterrupt(const solver::Interrupt* interrupt) override { interrupt_ = interrupt; }

  const TissueStep& step(const std::vector<contact::Obstacle>& obstacles, double dt) override;

  void reset() override {
    StateReader in(equilibrium_.bytes());
    body_.restore(&in);
    body_.v.setZero();
    forget();
  }
  /// Sets particles from surface positions and velocities; others take those of the nearest surface
  /// point.
  void setPositions(int, const Points& positions, const Points& velocities) override;

  State state() const override {
    StateWriter out;
    body_.save(&out);
    tool_contact_.save(&out);
    rest_.save(&out);
    return {kind(), out.bytes()};
  }
  void restore(const State& state) override {
    checkKind(state, kind());
    StateReader in(state.bytes);
    body_.restore(&in);
    tool_contact_.restore(&in);
    rest_.restore(&in);
    in.finish();
    follow();
  }

  /// Least distance of particles [m].
  static double finestOf(const SamplingSettings& sampling) {
    return sampling.coarsest / (1 << (sampling.levels - 1));
  }

 private:
  static constexpr double kSafety = 0.7;  // factor of safety on the stable step [-]
  static constexpr int kMostSubSteps = 20000;

  // Held parts of triangles with all corners held, smaller than the smallest particles.
  std::vector<Umbrella::Anchor> heldParts(const fem::FreeMask& free,
                                          const SamplingSettings& sampling) const {
    std::vector<Umbrella::Anchor> parts;
    for (Eigen::Index t = 0; t < triangles_.cols(); ++t) {
      Mat3 corners;
      bool held = true;
      for (int k = 0; k < 3; ++k) {
        held = held && free.col(triangles_(k, t)).isZero();
        corners.col(k) = X_.col(triangles_(k, t));
      }
      if (!held) continue;
      const Vec3 u = corners.col(1) - corners.col(0), v = corners.col(2) - corners.col(0);
      const int n =
          static_cast<int>(std::ceil(3.0 * std::max(u.norm(), v.norm()) / finestOf(sampling)));
      const Vec3 area = 0.5 * u.cross(v) / (n * n);
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < 2 * (n - i) - 1; ++j) {  // orientations alternate
          const double a = (i + (j % 2 + 1) / 3.0) / n,
                       b = (std::floor(0.5 * j) + (j % 2 + 1) / 3.0) / n;
          parts.push_back({-1, corners.col(0) + a * u + b * v, area});
        }
      }
    }
    return parts;
  }
  std::string kind() const {
    return "sampled_elasticity, " + std::to_string(X_.cols()) + " points";
  }
  void forget() {
    tool_contact_.forget();
    rest_.wake();
    out_.clear();
    follow();
  }
  // The surface.
  void follow() {
    body_.surface().interpolate(body_.d, &x_);
    x_ += X_;
    body_.surface().interpolate(body_.v, &surface_v_);
  }
  // Integrator, with damping of all forces but contact: SpringIntegrator.
  double stableStep() const {
    const double w = 2.0 / body_.longestSteps().minCoeff(), own = 2.0 / body_.longestAlone();
    const double d = damping_ + lag_ * own * own;
    return kSafety * (std::sqrt(d * d + 4.0 * w * w) - d) / (w * w);
  }
  void refuseTooManySubSteps(double dt) const;
  void findEquilibrium();
  bool comeToRest();
  void endAtRest();
  int planSteps(double dt, bool* coarse);
  bool adapt(double dt);
  bool subStep(double h, double s);
  void report();

  Points X_;
  Eigen::Matrix3Xi triangles_;
  SampledBody body_;
  Vec3 gravity_;
  double damping_;  // mass damping [1/s]
  double lag_;      // stiffness damping [s]
  double finest_;   // least distance of particles [m]
  double most_change_;
  double step_;  // duration of a cycle [s]
  ToolContact tool_contact_;
  double size_;
  Rest rest_;
  double tolerance_;
  StateWriter equilibrium_, before_;  // equilibrium; state at the cycle's begin
  Points x_, surface_v_, on_surface_, forces_, contact_;
  const solver::Interrupt* interrupt_ = nullptr;
  TissueStep out_;
};

}  // namespace palpate::tissue
