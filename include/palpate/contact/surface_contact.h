// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "palpate/contact/penalty.h"
#include "palpate/fem/energy_term.h"

namespace palpate::contact {

class ContactSurface;

/// Precomputes contact data of a surface: `X`, rest positions, 3 x n [m]; `triangles`, 3 x m,
/// outward.
std::shared_ptr<const ContactSurface> makeContactSurface(const Points& X,
                                                         const Eigen::Matrix3Xi& triangles);
/// Whether `surface` was made of `X` and `triangles`.
bool isOf(const ContactSurface& surface, const Points& X, const Eigen::Matrix3Xi& triangles);

/// Frictionless contact of two soft surfaces, or of one with itself: an energy of the points of a,
/// then of b, 3 x n [m]. Samples of each surface touch the other one, each with half its area, so
/// that both surfaces are treated alike:
///
///   sum over samples  area / 2  psi(-g - o),
///
/// g being the signed distance of the sample from the nearest point of the other surface, negative
/// inside, and psi the energy of Penalty, whose radius is half of the other body's thickness. An
/// overlap o >= 0 at rest exerts no pressure. The gradient is exact, so forces and moments sum to
/// zero.
///
/// In self-contact a sample touches only triangles farther at rest than two mean edges, up to a
/// depth of one mean edge or half the body's thickness.
class SurfaceContact final : public fem::EnergyTerm {
 public:
  /// `b` null: of `a` with itself.
  SurfaceContact(std::shared_ptr<const ContactSurface> a, std::shared_ptr<const ContactSurface> b,
                 const Penalty& law);
  ~SurfaceContact() override;
  SurfaceContact(const SurfaceContact&) = delete;
  SurfaceContact& operator=(const SurfaceContact&) = delete;

  /// Finds candidates while no point moves farther from x than `way` [m]. Samples already deeper
  /// than half a mean edge of the other surface (one, in a thick body) are left out.
  void search(const Points& x, double way);
  /// Whether no point has moved farther than `way` since search().
  bool holds(const Points& x) const;
  /// Number of candidates of the last search().
  int numCandidates() const;
  /// Number of samples in contact at x, and the largest penetration [m].
  int numTouches(const Points& x, double* deepest) const;

  double value(const Points& x) const override;
  double addGradient(const Points& x, Points* g) const override;
  void addHessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const override;
  /// Limits a step: no sample goes more than half-way to the other body's middle, no point farther
  /// than `way` of the last search().
  double maxStep(const Points& x, const Points& d) const override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace palpate::contact
