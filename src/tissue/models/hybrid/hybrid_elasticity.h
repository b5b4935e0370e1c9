// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "palpate/contact/contact_potential.h"
#include "palpate/fem/energy_term.h"
#include "tissue/models/cells/cell_elasticity.h"
#include "touched_surface.h"

namespace palpate::tissue {

/// A region of tensors (TensorMassElasticity) and a linear, quasi-static part (LinearPart) that
/// share the points of a border. Points of the linear part alone have the fraction kInertia of
/// their mass, since integrators divide by masses.
///
/// Unknowns are the points of the region, kept points of the linear part, and its touchable surface
/// points (TouchedSurface); inner points are held in the minimisation, and recover() computes them.
/// At a recovered x energy and gradient are the elastic ones, except at fixed points: reactions().
///
/// Both parts are solved as one by default, or, after beginLoop(), with one exchange per cycle
/// [Cotin, Delingette, Ayache 2000]: the linear part has the border's displacements of the
/// exchange, and the region the forces for these.
class HybridElasticity final : public CellElasticity {
 public:
  static constexpr double kInertia = 1e-9;

  /// `region`: tetrahedra of `mesh`, ascending. `gravity` [m/s^2]. `acted`: see LinearPart::Load.
  /// @throws as CellElasticity and LinearPart
  HybridElasticity(const mesh::TetMesh& mesh, const fem::Composition& composition,
                   const std::vector<int>& region, const fem::FreeMask& free, const Vec3& gravity,
                   const std::vector<char>& acted);
  HybridElasticity(const HybridElasticity&) = delete;  // members refer to each other
  HybridElasticity& operator=(const HybridElasticity&) = delete;

  const Eigen::VectorXd& masses() const override { return inertia_; }
  fem::Stiffness makeMatrix() const override;
  double energy(const Points& x) override;
  double gradient(const Points& x, Points* g) override;
  /// The stiffness of touched points is in couplings().
  void hessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) override;
  double minJacobian(const Points& x) override;
  void relax(const Points& x) override;
  void save(StateWriter* out) const override;
  void restore(StateReader* in) override;

  /// Tetrahedra of the region, ascending.
  const std::vector<int>& region() const { return region_; }
  /// The linear part; null where all is region.
  const LinearPart* rest() const { return rest_ ? &*rest_ : nullptr; }
  /// Kept points that also belong to the region.
  int numBorder() const { return num_border_; }

  /// Sets the contact whose candidates tools may touch.
  /// @pre It outlives this.
  void follow(const contact::ContactPotential* contact) { contact_ = contact; }
  /// A term with second derivatives only; value and gradient are in this energy.
  const fem::EnergyTerm* couplings() const { return &couplings_; }

  /// Begins a cycle at x, 3 x n [m].
  void beginCycle(const Points& x);
  /// Computes the points of x that are no unknowns, in equilibrium.
  void recover(Points* x);
  /// The same without contact.
  void recoverUntouched(Points* x);
  /// Gradient of the linear part at LinearPart::fixed() [N].
  /// @pre recover().
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
  bool floats_ = false;                  // the linear part has no fixed point
  std::vector<int> unknowns_;            // points of the region and kept ones, ascending
  Vec3 middle_ = Vec3::Zero();           // centroid of these at rest [m]
  Mat3 inverse_inertia_ = Mat3::Zero();  // inverse moment of inertia with unit masses
  bool loops_ = false;
  Eigen::VectorXd u_c_, imposed_;  // displacements of kept points; those imposed in a loop [m]
  Eigen::VectorXd answered_;       // contact forces of the last cycle on the surface, 3 p [N]
  Eigen::VectorXd of_border_;
  double imposed_energy_ = 0.0;  // [J]
  Points loads_;                 // 3 x n, in the gradient [N]
  Points u_, f_, x_;
};

}  // namespace palpate::tissue
