// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "body_surroundings.h"
#include "palpate/base/state_bytes.h"
#include "palpate/fem/elasticity.h"
#include "palpate/fem/inversion_guard.h"
#include "palpate/fem/loads.h"
#include "palpate/mesh/mesh_change.h"
#include "palpate/tissue/fem/drive.h"
#include "palpate/tissue/fem/fem_tissue.h"
#include "tissue/touch/tool_contact.h"

namespace palpate::tissue {

/// Force of other bodies on a body.
struct InteractionForce {
  Vec3 sum = Vec3::Zero();  ///< [N]
  double norm = 0.0;        ///< Norm of the nodal forces [N].
};

/// State of a finite element body with elasticity, loads and contact, on which every step method
/// works.
struct FemBody {
  /// `surface`: boundary of the mesh; without columns it is computed. `samples`: of contact;
  /// default: samples of the surface.
  FemBody(const mesh::TetMesh& mesh, const fem::Composition& composition,
          const Surroundings& what_surrounds, const FemSettings& fem_settings,
          ThreadPool* thread_pool, Drive what_drives = {},
          std::shared_ptr<fem::Elasticity> own_elasticity = nullptr,
          const Eigen::Matrix3Xi& surface = {},
          const std::vector<contact::SurfaceSample>& samples = {});

  /// Sets positions and velocities, 3 x n [m], [m/s], and forgets what was known at x.
  void moveTo(const Points& positions, const Points& velocities);
  /// moveTo() without a past: relaxed, untouched, without forces.
  void startAt(const Points& positions, const Points& velocities);

  /// Upper bound of plausible forces, whose powers do not overflow [N].
  static constexpr double kMostForce = 1e30;
  /// Tolerance of the residual from the forces of the last cycle [N].
  double tolerance() const;
  /// Tolerance of the residual from the forces at x [N]; `gradient`: of the potential at x, 3 x n
  /// [N]; `others`: norm of other bodies' nodal forces [N].
  double toleranceHere(const Points& gradient, double others);
  /// Lower bound of both tolerances [N].
  double leastTolerance() const;
  /// Adds the contacts at x to `out`, and sets contact_force.
  void reportContacts(TissueStep* out);
  /// Energy of gravity, the loads and the surroundings at `at` [J]; g += its gradient, 3 x n [N].
  double addLoads(const Points& at, Points* g) const;
  /// Displacement of held components from x to their prescribed positions at fraction s of the
  /// cycle, 3 x n [m], zero where free. Returns false where all are zero.
  bool heldWay(double s, Points* way) const;
  /// Whether held components have prescribed motion.
  bool heldMoves() const { return drive.held || surroundings.carries(); }
  /// Writes the sum of the forces of all boundary conditions into `out`; `gradient`: of all
  /// energies at x, 3 x n [N].
  void reportSupport(const Points& gradient, TissueStep* out);

  /// Cells of the rest configuration, with materials.
  mesh::CellMesh cells() const;

  /// Takes over positions and state of `old`, the same body before the mesh adaptation `change`.
  void goOnFrom(const FemBody& old, const mesh::MeshChange& change);
  /// Writes the state between cycles.
  void save(StateWriter* out) const;
  /// @throws std::invalid_argument for the state of another body, or values that are not finite.
  void restore(StateReader* in);

  FemSettings settings;
  mesh::TetMesh mesh;
  fem::FreeMask free;
  ThreadPool* pool;
  double size;                ///< Diagonal of the bounding box at rest [m].
  std::vector<int> solid_of;  ///< Solid of each tetrahedron; empty: the first for all.
  Eigen::Matrix3Xi triangles;
  std::shared_ptr<fem::Elasticity> elasticity;
  fem::InversionGuard guard;  ///< Barrier against inversion in implicit methods.
  Drive drive;
  fem::DeadLoad gravity;
  BodySurroundings surroundings;
  ToolContact tool_contact;
  contact::ContactPotential& contact;            ///< Member of `tool_contact`.
  ToolPath& tool_path;                           ///< Member of `tool_contact`.
  double largest_poisson_ratio;                  ///< Largest of any solid at rest [-].
  std::string method;                            ///< Name of the step method; never "auto".
  std::string method_note;                       ///< Reason for the method, or a warning; or empty.
  int inviscid_solids;                           ///< Number of solids without viscous terms.
  Vec3 weight;                                   ///< Sum of the gravity forces, world [N].
  double force_floor;                            ///< Force of a small strain of one element [N].
  const solver::Interrupt* interrupt = nullptr;  ///< See TissueModel::setInterrupt().

  Points x, v;  ///< 3 x n, world [m], [m/s].
  /// Elastic energy at x, where known and independent of the step [J].
  std::optional<double> elastic_energy;
  /// Least det F at x, where known [-].
  std::optional<double> min_jacobian;
  /// Norms of nodal forces in the last cycle, of contact and supports [N].
  double contact_force = 0.0, support_force = 0.0;
  Points support_forces;  ///< Support forces at the end of the last cycle, 3 x n [N].

 private:
  double toleranceFor(double touching, double support) const;
  void findSupport(const Points& gradient, Points* forces);

  double weight_norm_;                          // norm of the nodal forces of gravity and loads [N]
  double least_force_;                          // least force for tolerances [N]
  std::vector<const fem::EnergyTerm*> around_;  // energy terms of `surroundings`
  Points around_gradient_, nodal_;
};

/// Positions in equilibrium under gravity and boundary conditions, 3 x n [m].
/// @throws std::invalid_argument if the supports do not hold the body, std::runtime_error if there
/// is no equilibrium.
Points equilibriumUnderLoads(FemBody* body);

}  // namespace palpate::tissue
