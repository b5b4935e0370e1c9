// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/base/thread_pool.h"
#include "palpate/base/types.h"
#include "palpate/fem/composition.h"
#include "palpate/fem/elastic_energy.h"
#include "palpate/mesh/mesh_change.h"
#include "palpate/mesh/point_location.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::fem {

using mesh::TetMesh;

/// Deformation and stress at a point.
struct PointState {
  Mat3 F;              ///< Deformation gradient.
  Mat3 cauchy_stress;  ///< Cauchy stress [Pa] in the world frame, with its viscous part.
};

/// Viscous state of a body, for restoreViscousState() of the same body.
struct ViscousState {
  virtual ~ViscousState() = default;
};

/// Elastic energy of a body of one kind of element, with derivatives. One virtual call per
/// assembly. Sums have a fixed order, so results are bitwise independent of the pool. Of a viscous
/// body it is the potential of the step of beginStep().
class Elasticity : public ElasticEnergy {
 public:
  virtual int numNodes() const = 0;

  /// Least det F of all integration points [-].
  virtual double minJacobian(const Points& x) = 0;
  /// Least det F anywhere in the elements [-]; of quadratic ones between integration points too.
  /// Single-threaded: not for every cycle.
  virtual double minJacobianWithin(const Points& x) { return minJacobian(x); }
  /// Deformation and stress at each of `places`, given in the body's mesh.
  virtual std::vector<PointState> states(const Points& x,
                                         const std::vector<mesh::Location>& places) = 0;
  /// W(x) of each solid of the composition [J].
  virtual Eigen::VectorXd energyBySolid(const Points& x) = 0;

  /// Volume at rest [m^3].
  virtual double volume() const = 0;
  /// Lumped masses, n, all positive [kg].
  virtual const Eigen::VectorXd& masses() const = 0;
  /// Lumped masses, with the contribution of each element to its nodes.
  virtual mesh::LumpedMasses lumpedMasses() const = 0;
  /// Nodal weights over gravity, n [kg]: times an acceleration, the forces of uniform gravity.
  /// Their sum is the mass.
  virtual const Eigen::VectorXd& loadWeights() const = 0;

  /// Begins a step of `h` [s]; infinite h: full relaxation, the default.
  virtual void beginStep(double h) = 0;
  /// Ends the step at x and updates the viscous state.
  virtual void endStep(const Points& x) = 0;
  /// Resets the viscous state to full relaxation at x.
  virtual void relax(const Points& x) = 0;
  /// Copies the viscous state; null for a body without.
  virtual std::unique_ptr<ViscousState> saveViscousState() const = 0;
  virtual void restoreViscousState(const ViscousState* state) = 0;

  /// Takes the viscous state of `old`, the same body before its mesh changed by `change`. Parts of
  /// an element inherit its values. A union takes the mean by volume, or with several integration
  /// points the nearest linear field in the mean square.
  /// @throws std::invalid_argument for a body of other elements or solids.
  virtual void goOnFrom(const Elasticity& old, const mesh::MeshChange& change) = 0;

  /// Writes the viscous state and that of the step.
  virtual void save(StateWriter* out) const = 0;
  /// @throws std::invalid_argument for the state of another body.
  virtual void restore(StateReader* in) = 0;
};

/// Names of elements for makeElasticity(); the first is the default.
std::vector<std::string> elementNames();
/// Whether an element has 10 nodes. @throws std::invalid_argument for an unknown one.
bool isQuadratic(const std::string& element);
/// The mesh that `element` needs: `mesh`, or its 10-node version with straight edges.
TetMesh meshFor(const std::string& element, const TetMesh& mesh);

/// Body of `element` at rest in `mesh`. `pool` may be null (one thread) and must outlive the body.
/// @throws std::invalid_argument for an unknown element, an unsuitable or inverted mesh (with the
/// number of the tetrahedron), or a law with fibres without frames.
std::unique_ptr<Elasticity> makeElasticity(const std::string& element, const TetMesh& mesh,
                                           const Composition& composition,
                                           ThreadPool* pool = nullptr);

}  // namespace palpate::fem
