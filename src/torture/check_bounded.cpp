// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "box.h"
#include "checks.h"

namespace palpate::torture {
namespace {

// Allowed distance in sizes; dragged tissue stretches by one or two.
constexpr double kAway = 10.0;

// Bound of the stress over the modulus. Tissue stretched tenfold has 1e3 by a law cubic in the
// stretch; ten times that, on the whole cross-section, cannot be a force of tissue.
constexpr double kStretched = 1e4;
constexpr double kInertia = 10.0;

// Whether stress grows faster than the cube of the stretch: exponentials and higher powers.
bool isSteep(const std::string& law) {
  constexpr std::array<const char*, 7> kLaws = {
      "veronda_westmann", "demiray", "guccione", "holzapfel_gasser_ogden",
      "holzapfel_ogden",  "ogden",   "yeoh"};
  return std::find(kLaws.begin(), kLaws.end(), law) != kLaws.end();
}

class Bounded : public Criterion {
 public:
  explicit Bounded(const TortureScene& scene)
      : scene_(scene),
        size_(scene.size()),
        box_{scene.organs.front().low, scene.organs.front().low + scene.organs.front().size} {
    for (const TortureOrgan& organ : scene.organs) {
      box_.take(organ.low);
      box_.take(organ.low + organ.size);
      const double area = scene.size() * scene.size();
      stiffness_force_ = std::max(stiffness_force_, organ.waveModulus() * area);
      mass_ += organ.density * organ.size.prod();
      steep_ = steep_ || isSteep(organ.law);
    }
    const Eigen::MatrixXd& q = scene.trajectory.values;
    for (Eigen::Index row = 0; row < static_cast<Eigen::Index>(scene.leave); ++row) {
      for (Eigen::Index k = 0; k + 2 < q.rows(); k += 6) box_.take(q.col(row).segment<3>(k));
    }
  }

  void placed(const sim::Simulator& simulator) override {
    for (int i = 0; i < simulator.numOrgans(); ++i) {
      const Points& x = simulator.positions(i);
      for (Eigen::Index k = 0; k < x.cols(); ++k) box_.take(x.col(k));
      // An organ enlarged ten times can throw a part ten times as far.
      const Vec3 extent = x.rowwise().maxCoeff() - x.rowwise().minCoeff();
      size_ = std::max(size_, extent.norm());
    }
  }

  std::string check(const Cycle& cycle) override {
    flown_ += scene_.thrown * cycle.dt;
    const double bound = kAway * size_ + flown_;
    for (int i = 0; i < cycle.simulator.numOrgans(); ++i) {
      const Points& x = cycle.simulator.positions(i);
      for (Eigen::Index k = 0; k < x.cols(); ++k) {
        const double away = box_.distance(x.col(k));
        if (!(away <= bound)) return said("a point is", away, "m away");
      }
    }
    // Forces of cycles reported as unsolved are not checked.
    return steep_ || !cycle.result.report.ok() ? "" : wrongForce(cycle);
  }

 private:
  std::string wrongForce(const Cycle& cycle) const {
    const double h = std::min(cycle.dt, cycle.result.report.step);
    if (!(h > 0.0)) return "";
    // Force that moves the whole organ within a step.
    const double inertia = kInertia * mass_ * scene_.size() / (h * h);
    const double bound = kStretched * stiffness_force_ + inertia;
    for (const sim::InstrumentResult& tool : cycle.result.instruments) {
      const double force = tool.solved.force.norm();
      if (tool.live && !(force <= bound)) {
        return said("a tool feels", force, "N,") + said(" at most", bound, "N");
      }
    }
    return "";
  }

  const TortureScene& scene_;
  double size_;
  Box box_;  // of rest, initial state and tool paths
  double stiffness_force_ = 0.0, mass_ = 0.0, flown_ = 0.0;
  bool steep_ = false;
};

}  // namespace

std::unique_ptr<Criterion> checkBounded(const TortureScene& scene) {
  return std::make_unique<Bounded>(scene);
}

}  // namespace palpate::torture
