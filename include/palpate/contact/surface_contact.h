// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "palpate/contact/penalty.h"
#include "palpate/fem/energy_term.h"

namespace palpate::contact {

class ContactSurface;

/// What is worth knowing of a surface once: `X` 3 x n, the body's points at rest [m], `triangles`
/// 3 x m, outward.
std::shared_ptr<const ContactSurface> makeContactSurface(const Points& X,
                                                         const Eigen::Matrix3Xi& triangles);
/// Whether it is that of these.
bool isOf(const ContactSurface& surface, const Points& X, const Eigen::Matrix3Xi& triangles);

/// Contact without friction of two soft surfaces, or of one with itself: an energy of the points of
/// a and then of b, 3 x n [m]. Samples of each surface, on a lattice of its triangles, feel the
/// other one; each for half of its area, so that both are treated alike:
///
///   sum over samples  area / 2  psi(-g - o),
///
/// g being the signed distance of the sample from the nearest point of the other surface, negative
/// inside, and psi the energy of Penalty, whose radius is half of the other body's thickness. What
/// overlaps at rest by o >= 0 does not press for that. The gradient is exact, so the forces have no
/// sum and no moment.
///
/// Against itself a sample feels only what was farther from it at rest than two of the surface's
/// mean edges are long, and only up to one of them, or half of the body's thickness, deep.
class SurfaceContact final : public fem::EnergyTerm {
 public:
  /// `b` null: of `a` with itself.
  SurfaceContact(std::shared_ptr<const ContactSurface> a, std::shared_ptr<const ContactSurface> b,
                 const Penalty& law);
  ~SurfaceContact() override;
  SurfaceContact(const SurfaceContact&) = delete;
  SurfaceContact& operator=(const SurfaceContact&) = delete;

  /// Finds the samples that may be inside while no point goes farther from x than `way` [m]. What
  /// is deeper inside already than half a mean edge of the other surface, or one if that body's
  /// radius is no less, is not found.
  void search(const Points& x, double way);
  /// Whether all points are that near.
  bool holds(const Points& x) const;
  /// Samples that the last search found.
  int numCandidates() const;
  /// Samples that press at x, and the deepest one's penetration [m].
  int numTouches(const Points& x, double* deepest) const;

  double value(const Points& x) const override;
  double addGradient(const Points& x, Points* g) const override;
  void addHessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const override;
  /// No sample may go deeper than half of what is left to the other body's middle, and no point
  /// farther at once than the last search's way.
  double maxStep(const Points& x, const Points& d) const override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace palpate::contact
