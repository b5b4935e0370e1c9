// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/fem/loads.h"
#include "palpate/solver/inertia.h"
#include "palpate/solver/potential.h"

namespace palpate::solver {

/// Damping forces mass M v + stiffness d/dt (elastic forces) [Rayleigh 1877; the second part is
/// stiffness K(x) v with the tangent K].
struct RayleighDamping {
  double mass = 0.0;       ///< [1/s]
  double stiffness = 0.0;  ///< [s]
};

/// {"backward_euler", "bdf2", "static"}; the first is the default.
std::vector<std::string> integratorNames();

/// Implicit steps in time, each the minimum of an incremental potential. With the backward
/// differences v = (x - x_hat)/k and a = (v - v_hat)/k,
///
///   backward_euler  k = h,     x_hat = x_n                      [Hairer, Wanner 1996, sec. IV.3]
///   bdf2            k = 2h/3,  x_hat = (4 x_n - x_{n-1})/3, likewise v_hat  [ibid., sec. V.1]
///   static          as backward_euler without mass: each step is an equilibrium
///
/// equilibrium M a + mass M v + f(x) + stiffness (f(x) - f_hat)/k = loads is where
///
///   1/2 sum_i m_i (1/k^2 + mass/k) |x_i - y_i|^2 + (1 + stiffness/k) W(x) - stiffness/k f_hat . x
///
/// has no gradient, y = x_hat + k v_hat/(1 + mass k). bdf2 takes a step of backward_euler after a
/// start and where h changes, which leaves its order at two unless that is all the time.
///
/// Where a step or start is far from equilibrium, the next step has no stiffness damping: f_hat
/// would be of no motion.
class Integrator {
 public:
  /// @throws std::invalid_argument for an unknown name.
  Integrator(const std::string& name, Eigen::VectorXd masses, const RayleighDamping& damping);

  /// Starts from x [m] and v [m/s], 3 x n, without history.
  void start(const Points& x, const Points& v);
  /// The gradient of the elastic energy at the start, for damping in proportion to stiffness, where
  /// forces are out of balance by `unbalanced` [N].
  void setElasticGradient(const Points& g, double unbalanced = 0.0);

  /// Begins a step of `h` [s] and sets the terms and `elastic_scale` of `potential`, which has
  /// them from addTerms().
  void beginStep(double h, Potential* potential);
  void addTerms(Potential* potential) const;
  /// Ends the step at x, where the elastic energy has the gradient `g` (read only if
  /// needsElasticGradient()) and forces were left out of balance by `unbalanced` [N].
  void endStep(const Points& x, const Points& g, double unbalanced = 0.0);

  bool needsElasticGradient() const { return damping_.stiffness > 0.0; }
  const Points& positions() const { return x_; }
  const Points& velocities() const { return v_; }
  /// Extrapolated displacement in `h` [s] by velocities and their last change, 3 x n [m].
  void extrapolate(double h, Points* way) const;
  /// Sets velocities to zero.
  void stop();
  const Eigen::VectorXd& masses() const { return masses_; }
  /// Inertial and mass damping forces on the nodes at x, 3 x n [N].
  void inertiaForces(const Points& x, Points* f) const { inertia_.forces(x, f); }

  /// Goes on from the x and v of the last start() with the past of `old`, an integrator of the same
  /// name and body on another mesh; `carry` brings a field of its nodes to these, components that
  /// are not `free`, 3 x n, have no velocity, and `elastic_gradient` is that of this body at x, 3 x
  /// n [N], asked only if needsElasticGradient().
  void goOnFrom(const Integrator& old, const Eigen::Matrix3Xd& free,
                const std::function<Points(const Points&)>& carry,
                const std::function<Points(const Points&)>& elastic_gradient);

  /// Writes the state between steps.
  void save(StateWriter* out) const;
  /// @throws std::invalid_argument for the state of another body.
  void restore(StateReader* in);

 private:
  bool two_step_, massless_;
  Eigen::VectorXd masses_;
  RayleighDamping damping_;
  Inertia inertia_;
  fem::DeadLoad damping_load_;

  Points x_, v_, g_;              // of now
  Points x_old_, v_old_, g_old_;  // one step before
  double h_old_ = 0.0;            // its length; 0: there was none
  bool balanced_ = true, balanced_old_ = true;
  Points x_hat_, v_hat_, g_hat_, y_;  // of the present step
  double h_ = 0.0, k_ = 0.0;
};

}  // namespace palpate::solver
