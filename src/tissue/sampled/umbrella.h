// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/material/material.h"
#include "particle_tree.h"

namespace palpate::tissue {

/// What acts between particles: elastodynamics
///
///   rho a = mu L + (lambda + mu) G
///
/// with umbrella operators for the Laplacian of the displacement and the gradient of its divergence
/// [Debunne et al. 1999; Wang 2005, (2.9)-(2.11)], l the way to a neighbour at rest, d
/// displacement,
///
///   L_i = 2/(sum |l|) sum (d_j - d_i)/|l|,   G_i = 2/(sum |l|) sum ((d_j - d_i) . l) l/|l|^3.
///
/// "published" takes them as they are. Over directions that are all alike they are
/// (Laplacian)/3 and (Laplacian + 2 grad div)/15, and the forces of a pair are not opposite where
/// its ends have other neighbours. "consistent" therefore has (3 mu - 3/2 (lambda + mu)) L + 15/2
/// (lambda + mu) G, or above Poisson's ratio 1/4, where the first factor is negative, 6 E G; and
/// for each pair the mean of both ends' weights.
class Umbrella {
 public:
  /// A pair, or a particle and what holds it (b = -1).
  struct Link {
    int a, b;              ///< Into the leaves.
    Vec3 direction;        ///< Of b from a, at rest, unit; of what holds a, its normal.
    double across, along;  ///< Stiffness for a [N/m].
    double of_b;           ///< Times minus the force on a: that on b.
  };
  /// A part of the surface that is held, which holds the particle behind it as the tissue between
  /// them would: its area over their distance times lambda + 2 mu along the normal, mu across.
  struct Anchor {
    int leaf;   ///< Into the leaves.
    Vec3 X;     ///< Its middle [m].
    Vec3 area;  ///< Outward [m^2].
  };

  Umbrella(const material::Moduli& moduli, double density, const std::string& weights);

  /// Links of these leaves, `particles` of the tree.
  void build(const ParticleTree& tree, const std::vector<int>& leaves,
             const std::vector<Anchor>& anchors);
  const std::vector<Link>& links() const { return links_; }

  /// Force on a link's end a where b has gone by `way` more than it [N]; that on b in `on_b`.
  static Vec3 force(const Link& link, const Vec3& way, Vec3* on_b) {
    const Vec3& n = link.direction;
    const Vec3 f = link.across * way + (link.along - link.across) * n.dot(way) * n;
    *on_b = -link.of_b * f;
    return f;
  }
  /// |h^2 Laplacian| of each leaf, h the mean distance of its neighbours [m].
  void bend(const Points& d, Eigen::VectorXd* bends) const;
  /// Longest stable steps of each leaf by the sums of its links' stiffnesses [Gershgorin 1931],
  /// beside others `beside` [N/m], for masses [kg].
  Eigen::VectorXd longestSteps(const Eigen::VectorXd& masses, const Eigen::VectorXd& beside) const;
  /// h sqrt(rho/(lambda + 2 mu)) of a spacing h, (2.14) [s].
  double publishedStep(double h) const;
  double energy(const Points& d) const;
  /// Of each leaf, the forces at displacements d, 3 x n [N].
  void forces(const Points& d, Points* f, Vec3* on_anchors) const;

 private:
  double lambda_, mu_;
  double laplacian_, divergence_;  // factors of L and G [Pa]
  double wave_speed_;              // of pressure [m/s]
  bool symmetric_;
  std::vector<Link> links_;
  Eigen::VectorXd lengths_, counts_;  // of each leaf: sum of |l| [m], number of links
};

}  // namespace palpate::tissue
