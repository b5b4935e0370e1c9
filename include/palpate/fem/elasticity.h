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

/// What there is at a point of a deformed body.
struct PointState {
  Mat3 F;              ///< Deformation gradient.
  Mat3 cauchy_stress;  ///< [Pa], in world, with its viscous part.
};

/// Viscous memory of a body, to be given back to the body that it came from.
struct ViscousState {
  virtual ~ViscousState() = default;
};

/// Elastic energy of a body of one kind of element, with its derivatives. One virtual call an
/// assembly, never one an element. Sums run in a fixed order: same x, same bits, whatever the pool.
/// The energy of a viscous body is the potential of the step that beginStep() began.
class Elasticity : public ElasticEnergy {
 public:
  virtual int numNodes() const = 0;

  /// Smallest det F of any integration point.
  virtual double minJacobian(const Points& x) = 0;
  /// Smallest det F that is found anywhere in the elements: of linear ones the same; of quadratic
  /// ones between integration points as well. By one thread: not for every cycle.
  virtual double minJacobianWithin(const Points& x) { return minJacobian(x); }
  /// At each of `places`, in the body's mesh.
  virtual std::vector<PointState> states(const Points& x,
                                         const std::vector<mesh::Location>& places) = 0;
  /// W(x) of each solid of the composition [J].
  virtual Eigen::VectorXd energyBySolid(const Points& x) = 0;

  /// At rest [m^3].
  virtual double volume() const = 0;
  /// Lumped masses, n, all positive [kg].
  virtual const Eigen::VectorXd& masses() const = 0;
  /// The same, with what each element gives to its nodes.
  virtual mesh::LumpedMasses lumpedMasses() const = 0;
  /// Times an acceleration: the nodal forces of a uniform gravity, n [kg]. Their sum is the mass.
  virtual const Eigen::VectorXd& loadWeights() const = 0;

  /// Begins a step of `h` [s]; infinity, as before the first: all has relaxed that can.
  virtual void beginStep(double h) = 0;
  /// Ends the step at x: the body remembers what it went through.
  virtual void endStep(const Points& x) = 0;
  /// Forgets: the body has been at x for ever.
  virtual void relax(const Points& x) = 0;
  /// Null for a body that is not viscous.
  virtual std::unique_ptr<ViscousState> saveViscousState() const = 0;
  virtual void restoreViscousState(const ViscousState* state) = 0;

  /// Goes on from what `old` remembers, the same body on another mesh, of which this one's came by
  /// `change`: parts of an element have what it had, an element of several parts their mean by
  /// volume, or with several integration points the linear field nearest to theirs.
  /// @throws std::invalid_argument for a body of other elements or solids.
  virtual void goOnFrom(const Elasticity& old, const mesh::MeshChange& change) = 0;

  /// All memory: what viscous solids went through, and the step that was begun.
  virtual void save(StateWriter* out) const = 0;
  /// @throws std::invalid_argument for the memory of another body.
  virtual void restore(StateReader* in) = 0;
};

/// Names that makeElasticity() knows; the first is the default.
std::vector<std::string> elementNames();
/// Whether an element has 10 nodes. @throws std::invalid_argument for an unknown one.
bool isQuadratic(const std::string& element);
/// The mesh that `element` needs: `mesh`, or its 10-node version with straight edges.
TetMesh meshFor(const std::string& element, const TetMesh& mesh);

/// Body of `element` at rest in `mesh`. `pool` may be null (one thread) and must outlive the body.
/// @throws std::invalid_argument for an unknown element, a mesh that the element cannot use (with
/// the number of an inverted tetrahedron), or a law with fibres where there are no frames.
std::unique_ptr<Elasticity> makeElasticity(const std::string& element, const TetMesh& mesh,
                                           const Composition& composition,
                                           ThreadPool* pool = nullptr);

}  // namespace palpate::fem
