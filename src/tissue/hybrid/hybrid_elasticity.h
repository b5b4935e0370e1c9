// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "palpate/contact/contact_potential.h"
#include "palpate/fem/energy_term.h"
#include "tissue/cells/cell_elasticity.h"
#include "touched_surface.h"

namespace palpate::tissue {

/// A region of tensors (TensorMassElasticity) and a rest that is linear and quasi-static
/// (LinearPart), which share the points of a border. Points of the rest alone have no inertia but
/// a part kInertia of their mass, which integrators divide by.
///
/// Unknowns are the points of the region, those that the rest keeps, and of its surface those that
/// tools may touch (TouchedSurface). Where all others are, recover() says; whoever minimises holds
/// those that are inner. At x from there the energy is the elastic energy and the gradient its
/// gradient, but for points that are held for ever, which reactions() knows.
///
/// Both are solved together, as at first, or, after beginLoop(), with one exchange a cycle [Cotin,
/// Delingette, Ayache 2000]: until the next one the rest has the border's displacements of that
/// moment, and the region feels the forces that they need.
class HybridElasticity final : public CellElasticity {
 public:
  static constexpr double kInertia = 1e-9;

  /// `region`: tetrahedra of `mesh`, ascending. `gravity` [m/s^2]. `acted`: see LinearPart::Load.
  /// @throws as CellElasticity and LinearPart
  HybridElasticity(const mesh::TetMesh& mesh, const fem::Composition& composition,
                   const std::vector<int>& region, const fem::FreeMask& free, const Vec3& gravity,
                   const std::vector<char>& acted);
  HybridElasticity(const HybridElasticity&) = delete;  // parts refer to each other
  HybridElasticity& operator=(const HybridElasticity&) = delete;

  const Eigen::VectorXd& masses() const override { return inertia_; }
  fem::Stiffness makeMatrix() const override;
  double energy(const Points& x) override;
  double gradient(const Points& x, Points* g) override;
  /// That of touched points is in couplings().
  void hessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) override;
  double minJacobian(const Points& x) override;
  void relax(const Points& x) override;
  void save(StateWriter* out) const override;
  void restore(StateReader* in) override;

  /// Tetrahedra of tensors, ascending.
  const std::vector<int>& region() const { return region_; }
  /// Null where all is region.
  const LinearPart* rest() const { return rest_ ? &*rest_ : nullptr; }
  /// Kept points that belong to the region, too.
  int numBorder() const { return num_border_; }

  /// What tools may touch: the candidates of `contact`, which outlives this, at any time.
  void follow(const contact::ContactPotential* contact) { contact_ = contact; }
  /// A term of the potential, whose derivatives beside the second are in this energy.
  const fem::EnergyTerm* couplings() const { return &couplings_; }

  /// A cycle begins at x, 3 x n [m].
  void beginCycle(const Points& x);
  /// Puts the points of x that are no unknowns where they are in balance.
  void recover(Points* x);
  /// The same, of a body that nothing touches.
  void recoverUntouched(Points* x);
  /// After recover(), where there is a rest: its gradient at LinearPart::fixed() [N].
  void reactions(Points* g) { rest_->reactions(g); }
  void beginLoop(const Points& x);
  /// longestLoopStep() with this damping by mass [1/s], [s].
  double longestStepOfLoop(const fem::FreeMask& free, double damping) const;

 private:
  class Couplings final : public fem::EnergyTerm {
   public:
    explicit Couplings(HybridElasticity* all) : all_(*all) {}
    double value(const Points&) const override { return 0.0; }
    double addGradient(const Points&, Points*) const override { return 0.0; }
    void addHessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const override;

   private:
    HybridElasticity& all_;
  };

  Mat3 cauchyStress(const Points& x, int t, const Mat3& F) override;
  double energyOf(const Points& x, int t) override;
  void lookForTouches();
  void measureInertia();
  Vec3 armOf(int i) const { return mesh().points.col(i) - middle_; }
  void removeRigidMotion(Points* u) const;
  void exchange();
  const Eigen::VectorXd& displacementsOfRest(const Points& x);

  std::vector<int> region_;
  Eigen::VectorXd inertia_;  // n [kg]
  std::optional<LinearPart> rest_;
  std::optional<TouchedSurface> touched_;
  int num_border_ = 0;
  fem::BlockMatrix together_, tensors_;  // of region and rest, of the region alone; one pattern
  Couplings couplings_{this};
  const contact::ContactPotential* contact_ = nullptr;
  std::vector<int> candidates_;
  bool floats_ = false;                  // the rest is held at no point for ever
  std::vector<int> unknowns_;            // of the region and kept ones, ascending
  Vec3 middle_ = Vec3::Zero();           // of these at rest [m],
  Mat3 inverse_inertia_ = Mat3::Zero();  // of whose masses are 1
  bool loops_ = false;
  Eigen::VectorXd u_c_, imposed_;  // of the kept points, and in a loop as the rest has them [m]
  Eigen::VectorXd answered_;       // the last cycle's forces on the surface, 3 p [N]
  Eigen::VectorXd of_border_;
  double imposed_energy_ = 0.0;  // [J]
  Points loads_;                 // 3 x n, in the gradient [N]
  Points u_, f_, x_;
};

}  // namespace palpate::tissue
