// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "palpate/springs/spring_network.h"
#include "spring_forces.h"
#include "tissue/models/cells/cell_elasticity.h"

namespace palpate::tissue {

/// Elasticity of springs between the points of tetrahedra.
///
/// Tetrahedra provide masses and det F. A tetrahedron's share of a spring's energy is its share of
/// the volume around the spring.
class SpringElasticity final : public CellElasticity {
 public:
  /// `network`: springs between points of `mesh`, which need not be edges.
  /// @throws std::invalid_argument as springs::checkNetwork(), and for a network of other points.
  SpringElasticity(const mesh::TetMesh& mesh, const fem::Composition& composition,
                   const springs::SpringNetwork& network);

  fem::Stiffness makeMatrix() const override { return forces_.makeMatrix(); }
  double energy(const Points& x) override { return forces_.energy(x); }
  double gradient(const Points& x, Points* g) override { return forces_.gradient(x, g); }
  void hessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) override {
    forces_.hessian(x, tangent, K);
  }

  const SpringForces& forces() const { return forces_; }
  const SpringArrays& springs() const { return forces_.springs(); }

 private:
  Mat3 cauchyStress(const Points& x, int t, const Mat3& F) override;
  double energyOf(const Points& x, int t) override;
  /// Calls visit(spring, share) for springs along the edges of tetrahedron t.
  template <class Visit>
  void forEdges(int t, const Visit& visit) const;

  SpringForces forces_;
  std::vector<Eigen::Matrix<int, 6, 1>> of_tet_;  // springs along its edges, or -1
  std::vector<double> shared_;  // volume of the tetrahedra at each spring's edge [m^3]
};

}  // namespace palpate::tissue
