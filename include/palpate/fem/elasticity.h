// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/base/thread_pool.h"
#include "palpate/base/types.h"
#include "palpate/fem/block_matrix.h"
#include "palpate/material/material.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::fem {

using mesh::TetMesh;

/// What the tangent of an element is used for.
enum class Tangent {
  kExact,        ///< d2W/dx2 of the elements and of every term.
  kConvexTerms,  ///< Exact in the elements; terms leave out what is not positive semidefinite.
  kProjected,    ///< Elements too: their nearest positive semidefinite matrices.
};

/// Elastic energy of a body of one kind of element, with its derivatives. One virtual call an
/// assembly, never one an element. Sums run in a fixed order: same x, same bits, whatever the pool.
/// Not thread-safe: calls share scratch memory.
class Elasticity {
 public:
  virtual ~Elasticity() = default;

  virtual int numNodes() const = 0;
  /// A matrix with the body's pattern, all zero.
  virtual BlockMatrix makeMatrix() const = 0;

  /// W(x) [J] at positions `x`, 3 x n [m]; +infinity where the law has none (J <= 0).
  virtual double energy(const Points& x) = 0;
  /// W(x) and its gradient dW/dx, 3 x n [N]: minus the elastic forces. `g` is overwritten.
  virtual double gradient(const Points& x, Points* g) = 0;
  /// d2W/dx2 [N/m] into `K`, which has the body's pattern and is overwritten.
  virtual void hessian(const Points& x, Tangent tangent, BlockMatrix* K) = 0;

  /// Smallest det F of any integration point.
  virtual double minJacobian(const Points& x) const = 0;
  /// F of the first integration point of element `e`.
  virtual Mat3 deformationGradient(const Points& x, int e) const = 0;
  /// Rest volume that belongs to each node, n [m^3]; their sum is the body's volume.
  virtual const Eigen::VectorXd& nodalVolumes() const = 0;
};

/// Names that makeElasticity() knows.
std::vector<std::string> elementNames();

/// Body of `element` at rest in `mesh`. `pool` may be null (one thread) and must outlive the body.
/// @throws std::invalid_argument for an unknown element, or a mesh that the element cannot use.
std::unique_ptr<Elasticity> makeElasticity(const std::string& element, const TetMesh& mesh,
                                           const material::Material& material,
                                           ThreadPool* pool = nullptr);

}  // namespace palpate::fem
