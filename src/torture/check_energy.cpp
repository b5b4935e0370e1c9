// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "checks.h"
#include "organ_cells.h"
#include "palpate/fem/inversion_guard.h"
#include "textbook_solid.h"

namespace palpate::torture {
namespace {

// Bound of the energy over that at the begin, without input, for convex energies:
//   backward Euler, static: 1, since they only dissipate [Hairer, Wanner 1996, IV.12]
//   BDF2: 2, since |v|^2/4 + |2 v - v_before|^2/4 does not grow [Dahlquist 1978]
//   central differences, symplectic Euler, in 0.9 of the stable step: 1 / (1 - 0.9^2), since
//   1/2 v . (M - h^2/4 K) v + 1/2 x . K x is kept
//   trapezoidal, forward Euler, in 0.9 of the stable step: the largest squared norm of powers of
//   their matrices in (w x, v). With s = w^2 h^2 and a damping of e per step, it is at s = 1.8 e
//   and 0.9 e, both with e = 1.8
constexpr double kCentral = 1.0 / (1.0 - 0.9 * 0.9), kTrapezoidal = 6.64, kForward = 4.74;
double energyGrowthBound(const TortureScene& scene, const sim::Simulator& simulator) {
  const TortureOrgan& organ = scene.organs.front();
  if (organ.scheme == "trapezoidal_euler") return kTrapezoidal;
  if (organ.scheme == "forward_euler") return kForward;
  const bool explicit_springs = organ.scheme != "implicit";
  bool tled = false;
  for (int i = 0; i < simulator.numOrgans(); ++i) {
    for (const std::string& method : simulator.methods(i)) tled = tled || method == "tled";
  }
  if (tled || explicit_springs || organ.model == "sampled_elasticity") return kCentral;
  return scene.integrator == "bdf2" ? 2.0 : 1.0;
}

// Whether steps go from equilibrium to equilibrium, with velocities from differences of positions.
bool isQuasiStatic(const TortureScene& scene) {
  return scene.integrator == "static" || scene.method == "newton_bicgstab" ||
         scene.method == "linear_precomputed";
}

constexpr double kRounding = 1e-3;  // over the initial energy

// Rounding error of an energy whose terms, each as large as the stiffness, cancel at rest [J].
double roundingOf(const TortureOrgan& organ) {
  return 1e-12 + std::numeric_limits<double>::epsilon() * organ.waveModulus() * organ.size.prod();
}

// Kinetic energy of a thrown organ [J].
double kineticOf(const TortureOrgan& organ, double speed) {
  double volume = 0.0;
  for (Eigen::Index t = 0; t < organ.mesh.numTets(); ++t) {
    volume += mesh::signedVolume(organ.mesh.points, organ.mesh.tets.col(t));
  }
  return 0.5 * organ.density * volume * speed * speed;
}

class Energy : public Criterion {
 public:
  Energy(const TortureScene& scene, const sim::Simulator& simulator)
      : scene_(scene), bound_(energyGrowthBound(scene, simulator)) {
    const TortureOrgan& organ = scene.organs.front();
    // Not checked for viscous organs, whose stored energy is not reported, nor under gravity for
    // organs that switch between surrogate and elements.
    applies_ = organ.prony_g == 0.0;
    const mesh::CellMesh cells = simulator.cells(0);
    if (scene.gravity.isZero()) return;
    applies_ = applies_ && areLinearTets(cells) && organ.adapt == 0.0 && organ.model != "neural";
    if (applies_) {
      masses_ = TextbookSolid(cells, "tet4", {}, organ.density, Mat3::Identity()).loaded();
    }
  }

  std::string check(const Cycle& cycle) override {
    const sim::StepReport& report = cycle.result.report;
    const Points& x = cycle.simulator.positions(0);
    // Organs that fall on each other or on fixed bone transfer no energy to tools.
    const bool alone = cycle.row >= scene_.leave &&
                       (scene_.start == Start::kThrown || cycle.result.contacts.empty());
    const bool guarded = isGuarded(cycle.simulator);
    const bool put_back = report.recovery == static_cast<int>(tissue::Recovery::kPutBack);
    const bool goes_on = applies_ && alone && report.mesh_changes == 0 && report.usable() &&
                         !put_back && !guarded && before_.cols() == x.cols();
    if (goes_on) {
      double energy = report.elastic_energy;
      if (!isQuasiStatic(scene_)) energy += report.kinetic_energy;
      if (masses_.size() > 0) energy -= scene_.gravity.dot(x * masses_);
      if (energies_.empty()) forgiven_ = energy + report.tolerance * scene_.size();
      unbalanced_ += report.residual * (x - before_).norm();
      energies_.push_back(energy - std::min(unbalanced_, forgiven_));
    } else if (std::string wrong = finish(); !wrong.empty()) {
      return wrong;
    } else {
      energies_.clear();
      unbalanced_ = 0.0;
    }
    before_ = x;
    return "";
  }

  void placed(const sim::Simulator& simulator) override {
    before_ = simulator.positions(0);
    energies_.clear();
    unbalanced_ = 0.0;
    if (scene_.start != Start::kThrown) return;
    energies_.push_back(kineticOf(scene_.organs.back(), scene_.thrown));
    forgiven_ = energies_.front();
  }

  std::string finish() override {
    if (energies_.size() < 2) return "";
    const double least = *std::min_element(energies_.begin(), energies_.end());
    const double most = *std::max_element(energies_.begin(), energies_.end());
    const double first = energies_.front() - least;
    if (most - least <= (bound_ + kRounding) * first + roundingOf(scene_.organs.front())) {
      return "";
    }
    return said("grew from", first, "to") + said("", most - least, "J,") +
           said(" the integrator's bound is", bound_, "times");
  }

 private:
  // Elements with det F below the guard's limit have its energy, which is converted when they
  // recover.
  bool isGuarded(const sim::Simulator& simulator) {
    const std::uint64_t revision = simulator.surfaceState(0).revision;
    if (!guard_ || revision_ != revision) {
      const mesh::CellMesh cells = simulator.cells(0);
      mesh::TetMesh mesh;
      mesh.points = cells.points;
      if (areLinearTets(cells) || areQuadraticTets(cells)) mesh.tets = cells.cells.topRows(4);
      if (areQuadraticTets(cells)) mesh.midnodes = cells.cells.bottomRows(6);
      guard_ = std::make_unique<fem::InversionGuard>(mesh, 1.0);
      revision_ = revision;
    }
    return guard_->least(simulator.positions(0)) < fem::InversionGuard::kLeast;
  }

  const TortureScene& scene_;
  double bound_;
  std::unique_ptr<fem::InversionGuard> guard_;
  std::uint64_t revision_ = 0;
  bool applies_ = true;
  Eigen::VectorXd masses_;
  Points before_;
  std::vector<double> energies_;
  // Bounds of the work of residual forces, at most the initial energy, and of forces within the
  // tolerance over a distance of the organ's size [J].
  double unbalanced_ = 0.0, forgiven_ = 0.0;
};

}  // namespace

std::unique_ptr<Criterion> checkEnergy(const TortureScene& scene, const sim::Simulator& simulator) {
  return std::make_unique<Energy>(scene, simulator);
}

}  // namespace palpate::torture
