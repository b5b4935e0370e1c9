// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/base/types.h"
#include "palpate/fem/composition.h"
#include "palpate/mesh/mesh_change.h"

namespace palpate::fem {

/// Viscous memory of the integration points. With S the second Piola-Kirchhoff stress of the
/// distortional energy, and x_i = h/tau_i, the stress at the end of a step of length h is
///
///     (1 - sum g_i) S + sum Q_i,   Q_i <- exp(-x_i) Q_i + g_i (1 - exp(-x_i))/x_i (S - S_begin)
///
/// [Holzapfel 2000, sec. 6.10, after Simo 1987; Taylor, Pister, Goudreau 1970 for the recursion],
/// exact for an S that changes linearly over the step. It is the gradient of factor * psi + 1/2 H :
/// (C - I) with what this class gives, so that a viscous step, too, minimises a potential.
class PronyHistory {
 public:
  PronyHistory(const Composition& composition, int num_elements, int points_per_element);

  /// No solid of the body is viscous: nothing below is to be called.
  bool empty() const { return points_.empty(); }

  /// Begins a step of `h` [s]; infinity: whatever can relax has.
  void beginStep(double h);
  /// Of the distortional energy, for `solid`.
  double factor(int solid) const { return factor_[solid]; }
  /// H at integration point `q` of element `e`, symmetric [Pa].
  const Mat3& stress(int e, int q) const { return points_[e * points_per_element_ + q].H; }

  /// Ends the step with the stress `S` at that point.
  void endStep(int e, int q, const Mat3& S);
  /// The point has had the stress `S` for ever.
  void relax(int e, int q, const Mat3& S);

  /// As Elasticity::goOnFrom(); `old_volumes` of the old elements.
  void goOnFrom(const PronyHistory& old, const mesh::MeshChange& change,
                const std::vector<double>& old_volumes);
  void save(StateWriter* out) const;
  /// @throws std::invalid_argument for the memory of another body.
  void restore(StateReader* in);

 private:
  struct Term {
    double g, tau, decay, gain;  // exp(-x), g (1 - exp(-x))/x
  };
  struct Point {
    Mat3 S = Mat3::Zero(), H = Mat3::Zero();
    std::vector<Mat3> Q;
  };
  const std::vector<Term>& terms(int e) const { return terms_[solid_of_[e]]; }

  int points_per_element_;
  std::vector<int> solid_of_;
  std::vector<std::vector<Term>> terms_;  // of each solid
  std::vector<double> factor_;
  std::vector<Point> points_;
};

}  // namespace palpate::fem
