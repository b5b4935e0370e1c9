// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "palpate/springs/spring_network.h"
#include "spring_arrays.h"
#include "tissue/cells/cell_elasticity.h"

namespace palpate::tissue {

/// The energy of springs between the points of tetrahedra [Wang 2005, sec. 2.2]:
///
///   W = sum over springs  P (u - u0) + k/2 (u - u0)^2,   u the distance of its ends.
///
/// Tetrahedra only carry masses, and say where space is turned inside out; each has of a spring's
/// energy what its volume is of those that share the spring.
class SpringElasticity final : public CellElasticity {
 public:
  /// `network`: springs between points of `mesh`, which need not be edges.
  /// @throws std::invalid_argument as springs::checkNetwork(), and for a network of other points.
  SpringElasticity(const mesh::TetMesh& mesh, const fem::Composition& composition,
                   const springs::SpringNetwork& network);

  fem::Stiffness makeMatrix() const override;
  double energy(const Points& x) override;
  double gradient(const Points& x, Points* g) override;
  void hessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) override;

  const SpringArrays& springs() const { return springs_; }
  /// Bound of the squares of all frequencies, in any shape: springs::largestStep() [1/s^2].
  double largestSquare() const { return largest_square_; }

 private:
  Mat3 cauchyStress(const Points& x, int t, const Mat3& F) override;
  double energyOf(const Points& x, int t) override;
  /// visit(spring, share) of those along the edges of tetrahedron t.
  template <class Visit>
  void forEdges(int t, const Visit& visit) const;

  SpringArrays springs_;
  double largest_square_;
  std::vector<Eigen::Matrix<int, 6, 1>> of_tet_;  // springs along its edges, or -1
  std::vector<double> shared_;  // volume of the tetrahedra at each spring's edge [m^3]
};

}  // namespace palpate::tissue
