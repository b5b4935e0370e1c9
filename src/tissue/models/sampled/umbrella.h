// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/material/material.h"
#include "particle_tree.h"

namespace palpate::tissue {

/// Forces between particles: elastodynamics
///
///   rho a = mu L + (lambda + mu) G
///
/// with umbrella operators for the Laplacian of the displacement and the gradient of its divergence
/// [Debunne et al. 1999; Wang 2005, (2.9)-(2.11)], l the way to a neighbour at rest, d
/// displacement,
///
///   L_i = 2/(sum |l|) sum (d_j - d_i)/|l|,   G_i = 2/(sum |l|) sum ((d_j - d_i) . l) l/|l|^3.
///
/// "published" uses these operators. With isotropic directions they are (Laplacian)/3 and
/// (Laplacian + 2 grad div)/15, and forces of a pair are not opposite where its ends have different
/// neighbours. "consistent" therefore uses (3 mu - 3/2 (lambda + mu)) L + 15/2 (lambda + mu) G, or
/// 6 E G above Poisson's ratio 1/4, where the first factor is negative, with the mean weights of a
/// pair's ends.
class Umbrella {
 public:
  /// A pair of particles, or a particle and a support (b = -1).
  struct Link {
    int a, b;              ///< Into the leaves.
    Vec3 direction;        ///< Direction from a to b at rest, or normal of the support, unit.
    double across, along;  ///< Stiffness across and along `direction` for a [N/m].
    double of_b;           ///< Force on b over minus that on a [-].
  };
  /// A held part of the surface. Stiffness for the particle behind it: area over distance, times
  /// lambda + 2 mu along the normal and mu across.
  struct Anchor {
    int leaf;   ///< Index of a leaf.
    Vec3 X;     ///< Middle [m].
    Vec3 area;  ///< Outward [m^2].
  };

  Umbrella(const material::Moduli& moduli, double density, const std::string& weights);

  /// Makes the links of these leaves; `particles`: of the tree.
  void build(const ParticleTree& tree, const std::vector<int>& leaves,
             const std::vector<Anchor>& anchors);
  const std::vector<Link>& links() const { return links_; }

  /// Force on end a of a link for the relative displacement `way` of b [N]; that on b in `on_b`.
  static Vec3 force(const Link& link, const Vec3& way, Vec3* on_b) {
    const Vec3& n = link.direction;
    const Vec3 f = link.across * way + (link.along - link.across) * n.dot(way) * n;
    *on_b = -link.of_b * f;
    return f;
  }
  /// |h^2 Laplacian| of each leaf, with the mean distance h of its neighbours [m].
  void bend(const Points& d, Eigen::VectorXd* bends) const;
  /// Longest stable step of each leaf, by the sums of its links' stiffnesses [Gershgorin 1931] plus
  /// the stiffnesses `beside` of other springs [N/m], for masses [kg].
  Eigen::VectorXd longestSteps(const Eigen::VectorXd& masses, const Eigen::VectorXd& beside) const;
  /// h sqrt(rho/(lambda + 2 mu)) of a spacing h: (2.14) [s].
  double publishedStep(double h) const;
  double energy(const Points& d) const;
  /// Computes the forces of the leaves at displacements d, 3 x n [N].
  void forces(const Points& d, Points* f, Vec3* on_anchors) const;

 private:
  double lambda_, mu_;
  double laplacian_, divergence_;  // factors of L and G [Pa]
  double wave_speed_;              // speed of pressure waves [m/s]
  bool symmetric_;
  std::vector<Link> links_;
  Eigen::VectorXd lengths_, counts_;  // of each leaf: sum of |l| [m], number of links
};

}  // namespace palpate::tissue
