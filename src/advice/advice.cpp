// SPDX-License-Identifier: GPL-3.0-or-later
#include "advice.h"

#include <algorithm>
#include <cmath>

#include "palpate/base/number.h"

namespace palpate::advice {
namespace {

constexpr double kCoarsest = 3.0;         // largest factor on edges; beyond, shapes are lost
constexpr double kUsualPoisson = 0.45;    // with few iterations
constexpr int kWorthThreads = 1000;       // nodes from which threads save a quarter of a cycle
constexpr double kThreadShare = 0.6;      // time of shared loops with two threads, relative
constexpr double kSmallestChange = 0.95;  // relative cycle time; smaller gains are noise
constexpr std::size_t kMostAdvice = 5;

std::string rounded(double x) {
  const double scale = std::pow(10.0, 2.0 - std::floor(std::log10(std::abs(x))) - 1.0);
  return formatNumber(std::round(x * scale) / scale);
}

// Estimates the time of the slowest cycles after changes.
class Adviser {
 public:
  Adviser(const SceneFacts& facts, const CycleCosts& figures)
      : facts_(facts),
        now_(figures.slow),
        figures_(figures),
        wanted_(1.0 / facts.rates.simulation) {
    // Scales the phases of the slowest cycles to the 99th percentile.
    scale_ = now_.cycle() > 0.0 ? figures.cycle_p99 / now_.cycle() : 0.0;
  }

  std::vector<Advice> all() {
    coarsen();
    relaxPoisson();
    relaxContact();
    spreadSamples();
    addThread();
    changeMethod();
    loosenLinear();
    std::sort(advice_.begin(), advice_.end(),
              [](const Advice& a, const Advice& b) { return a.cycle < b.cycle; });
    if (advice_.size() > kMostAdvice) advice_.resize(kMostAdvice);
    lengthenStep();
    return advice_;
  }

 private:
  double part(Phase phase) const { return scale_ * now_[phase]; }
  double cycle() const { return scale_ * now_.cycle(); }
  bool iterative() const { return solvesBy(solver::LinearSystems::kIterations); }
  bool direct() const { return solvesBy(solver::LinearSystems::kFactor); }
  bool solvesBy(solver::LinearSystems way) const { return facts_.method.linear_systems == way; }
  bool costs(Phase phase, double share) const { return part(phase) >= share * cycle(); }

  void add(const std::string& text, double cycle_then) {
    if (cycle_then <= kSmallestChange * cycle()) advice_.push_back({text, cycle_then});
  }

  // Edges s times as long mean s^-3 times the nodes. Conjugate gradients need s^-1 times the
  // iterations; factorisation in 3D grows with the square of the nodes [George 1973]; contact
  // samples stay. Adaptive meshes have most edges elsewhere: slow cycles of the shipped liver take
  // 17.3, 12.9 and 10.8 ms with 2, 3 and 4 mm at the tool.
  double coarser(double s) const {
    if (facts_.finest > 0.0) {
      return part(Phase::kContact) + std::pow(s, -0.75) * (cycle() - part(Phase::kContact));
    }
    const double nodes = std::pow(s, -3.0);
    const double linear = direct() ? nodes * nodes : nodes / s;
    return part(Phase::kContact) + linear * part(Phase::kLinearSolve) +
           nodes * (cycle() - part(Phase::kContact) - part(Phase::kLinearSolve));
  }

  void coarsen() {
    double low = 1.0, high = kCoarsest;
    if (coarser(high) > wanted_) {
      low = high;
    } else {
      for (int k = 0; k < 40; ++k) {
        const double middle = 0.5 * (low + high);
        (coarser(middle) > wanted_ ? low : high) = middle;
      }
    }
    const std::string edge =
        rounded(facts_.edge_length) + " m to " + rounded(high * facts_.edge_length) + " m";
    if (facts_.finest > 0.0) {
      add("raise adapt.finest of organ " + facts_.organ + " from " + rounded(facts_.finest) +
              " m to " + rounded(high * facts_.finest) + " m (coarser: less accurate forces)",
          coarser(high));
      return;
    }
    if (facts_.graded) {
      add("raise coarsest and finest in edge_length of organ " + facts_.organ + " by a factor of " +
              rounded(high) + " (coarser: less accurate forces; or let edges grow faster)",
          coarser(high));
      return;
    }
    add(facts_.meshed ? "raise edge_length of organ " + facts_.organ + ", whose edges are now " +
                            edge + " (coarser: less accurate forces)"
                      : "give organ " + facts_.organ + " a coarser mesh, edges from " + edge,
        coarser(high));
  }

  // Iterations grow as (1 - 2 nu)^-1/2; measured: 15, 33 and 114 at 0.45, 0.49 and 0.499.
  void relaxPoisson() {
    if (!iterative() || facts_.poisson_ratio <= kUsualPoisson + 1e-3) return;
    const double left = std::sqrt((1.0 - 2.0 * std::min(facts_.poisson_ratio, 0.4999)) /
                                  (1.0 - 2.0 * kUsualPoisson));
    add("lower poisson_ratio from " + rounded3(facts_.poisson_ratio) + " to 0.45",
        cycle() - (1.0 - left) * part(Phase::kLinearSolve));
  }

  // Stiff contact causes more than about two Newton iterations per stage.
  void relaxContact() {
    const double all = figures_.newton_per_cycle;
    if (all <= 2.5) return;
    const double contact_free = part(Phase::kContact) + part(Phase::kForces) + part(Phase::kOther);
    if (facts_.contact.model != "penalty") {  // penalty stiffness follows from the tissue
      const double left = std::max(2.0 / all, 0.9);
      add("take contact.model: penalty (deeper penetration, fewer Newton iterations)",
          contact_free + left * (cycle() - contact_free));
      return;
    }
    const double left = std::max(2.0 / all, 0.7);
    add("lower contact.stiffness from " + rounded(facts_.contact.stiffness) + " to " +
            rounded(facts_.contact.stiffness / 4.0) +
            " Pa/m (deeper penetration, fewer Newton iterations)",
        contact_free + left * (cycle() - contact_free));
  }

  // The number of samples is inversely proportional to the squared spacing.
  void spreadSamples() {
    if (!costs(Phase::kContact, 0.2)) return;
    const std::string now = facts_.contact.sample_spacing > 0.0
                                ? "double contact.sample_spacing to " +
                                      rounded(2.0 * facts_.contact.sample_spacing) + " m"
                                : std::string(
                                      "give contact.sample_spacing twice the half radius "
                                      "of the thinnest tool that it has by itself");
    add(now + " (a quarter of the samples)", cycle() - 0.75 * part(Phase::kContact));
  }

  void addThread() {
    if (facts_.solver.threads >= facts_.cores || facts_.solver.threads > 1) return;
    if (facts_.nodes < kWorthThreads) return;
    const double shared = part(Phase::kForces) + part(Phase::kAssembly) + part(Phase::kLineSearch) +
                          (facts_.method.shares_linear ? part(Phase::kLinearSolve) : 0.0);
    add("solver.threads: 2, if the second core has nothing else to do",
        cycle() - (1.0 - kThreadShare) * shared);
  }

  void changeMethod() {
    if (!costs(Phase::kLinearSolve, 0.4)) return;
    if (direct()) {
      add("solver.method: implicit_pcg, unless poisson_ratio is above 0.49",
          cycle() - 0.6 * part(Phase::kLinearSolve));
    } else if (iterative() && figures_.linear_per_newton > 80.0) {
      add("solver.method: implicit_async, which factorises on the second core",
          cycle() - 0.5 * part(Phase::kLinearSolve));
    }
  }

  // Each iteration reduces the residual by about the same factor.
  void loosenLinear() {
    if (!iterative() || facts_.solver.linear_tolerance >= 1e-2) return;
    const double left = std::log(1e-2) / std::log(facts_.solver.linear_tolerance);
    add("raise solver.linear_tolerance from " + formatNumber(facts_.solver.linear_tolerance) +
            " to 0.01",
        cycle() - (1.0 - left) * part(Phase::kLinearSolve));
  }

  // Always possible, hence last: real time is kept at a lower rate of forces.
  void lengthenStep() {
    const double step = std::ceil(1e3 * cycle()) / 1e3;
    if (step > 0.1 || 1.0 / step >= facts_.rates.simulation) return;
    advice_.push_back({"or leave the scene as it is and set solver.step: " + formatNumber(step) +
                           ", rates.simulation: " + rounded(std::floor(1.0 / step)) +
                           " (real time is kept, the force is newer less often)",
                       cycle()});
  }

  static std::string rounded3(double x) { return formatNumber(std::round(1e3 * x) / 1e3); }

  const SceneFacts& facts_;
  const PhaseTimes& now_;
  const CycleCosts& figures_;
  double wanted_, scale_ = 0.0;
  std::vector<Advice> advice_;
};

}  // namespace

std::vector<Advice> adviseOn(const SceneFacts& facts, const CycleCosts& figures) {
  return Adviser(facts, figures).all();
}

}  // namespace palpate::advice
