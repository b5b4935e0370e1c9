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

/// What other bodies do to one.
struct InteractionForce {
  Vec3 sum = Vec3::Zero();  ///< [N]
  double norm = 0.0;        ///< Of its nodal forces [N].
};

/// A body of finite elements, what acts on it, and where it is: what every method of stepping works
/// on.
struct FemBody {
  /// `surface`: of the mesh, where it is known already; without columns it is found. `samples`:
  /// where contact is felt, else there are samples of the surface.
  FemBody(const mesh::TetMesh& mesh, const fem::Composition& composition,
          const Surroundings& what_surrounds, const FemSettings& fem_settings,
          ThreadPool* thread_pool, Drive what_drives = {},
          std::shared_ptr<fem::Elasticity> own_elasticity = nullptr,
          const Eigen::Matrix3Xi& surface = {},
          const std::vector<contact::SurfaceSample>& samples = {});

  /// More than this no tissue has; its square and its fourth power leave what numbers there are
  /// [N].
  static constexpr double kMostForce = 1e30;
  /// Newton's tolerance [N] for the norm of unbalanced nodal forces, from the forces of the last
  /// cycle.
  double tolerance() const;
  /// The same from the forces at `at`, where the potential has `gradient`, 3 x n [N]; `others`: the
  /// nodal norm of what other bodies exert there [N].
  double toleranceAt(const Points& at, const Points& gradient, double others);
  /// What both are at least [N].
  double leastTolerance() const;
  /// Collects the contacts at x into `out`, and their nodal norm.
  void reportContacts(TissueStep* out);
  /// Energy of gravity, the loads and the surroundings at `at` [J]; g += its gradient, 3 x n [N].
  double addLoads(const Points& at, Points* g) const;
  /// The way that the held components have still to go at part s of the cycle, 3 x n [m], zero
  /// where free. False: they are there.
  bool heldWay(double s, Points* way) const;
  /// Whether held components move at all.
  bool heldMoves() const { return drive.held || surroundings.carries(); }
  /// Sums what the supports and all else that surrounds it exert, given the gradient of all
  /// energies at x (3 x n [N]).
  void reportSupport(const Points& gradient, TissueStep* out);

  /// The mesh at rest, and what it is made of.
  mesh::CellMesh cells() const;

  /// Takes over where `old` is, which is the same body on another mesh, of which this one's came
  /// by `change`, and what it remembers.
  void goOnFrom(const FemBody& old, const mesh::MeshChange& change);
  /// All memory from one cycle to the next.
  void save(StateWriter* out) const;
  /// @throws std::invalid_argument for the memory of another body, or one that is not finite.
  void restore(StateReader* in);

  FemSettings settings;
  mesh::TetMesh mesh;
  fem::FreeMask free;
  ThreadPool* pool;
  double size;                ///< Diagonal of the bounding box at rest [m].
  std::vector<int> solid_of;  ///< Of each tetrahedron; empty: all of the first.
  Eigen::Matrix3Xi triangles;
  std::shared_ptr<fem::Elasticity> elasticity;
  fem::InversionGuard guard;  ///< Of implicit methods.
  Drive drive;
  fem::DeadLoad gravity;
  BodySurroundings surroundings;
  ToolContact tool_contact;
  contact::ContactPotential& contact;  ///< Of `tool_contact`,
  ToolPath& tool_path;                 ///< likewise.
  double largest_poisson_ratio;        ///< Of any solid at rest.
  std::string method;                  ///< By which it is stepped; never "auto".
  std::string method_note;  ///< Why its method was chosen, or what is wrong with it; or empty.
  int inviscid_solids;      ///< Without viscous terms.
  Vec3 weight;              ///< Sum of the gravity forces [N].
  double force_floor;       ///< Of a small strain on one element [N].
  const solver::Interrupt* interrupt = nullptr;  ///< See TissueModel::setInterrupt().

  Points x, v;  ///< 3 x n, world [m], [m/s].
  /// At x, where it is known and does not depend on the step [J].
  std::optional<double> elastic_energy;
  /// Smallest det F at x, where it is known.
  std::optional<double> min_jacobian;
  /// Nodal norms of the last cycle [N]; of contact with tools and with other bodies.
  double contact_force = 0.0, support_force = 0.0;
  Points support_forces;  ///< On the nodes at the last cycle's end, 3 x n [N].

 private:
  double toleranceFor(double touching, double support) const;
  void findSupport(const Points& at, const Points& gradient, Points* forces);

  double weight_norm_;                          // of the nodal forces of gravity and loads [N]
  double least_force_;                          // worth being balanced [N]
  std::vector<const fem::EnergyTerm*> around_;  // the surroundings' terms
  Points around_gradient_, nodal_;
};

/// The equilibrium under the body's gravity and surroundings, 3 x n [m].
/// @throws std::invalid_argument if the supports do not hold the body, std::runtime_error if there
/// is no equilibrium.
Points equilibriumUnderLoads(FemBody* body);

}  // namespace palpate::tissue
