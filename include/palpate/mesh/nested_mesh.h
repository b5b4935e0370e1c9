// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "palpate/mesh/mesh_change.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::mesh {

/// Locally refined mesh by bisection of a coarse one. Nested: linear fields of the coarse mesh are
/// linear on the fine one, quadratic ones quadratic. Conforming: hanging nodes are bisected away.
/// Bisections and numbering depend only on the coarse mesh and the request, not on the history.
class NestedMesh {
 public:
  /// Mean rest edge length [m] for tetrahedra with the deformed centroid p [m]; no edge exceeds 1.6
  /// times that.
  using Size = std::function<double(const Vec3& p)>;

  /// Limits of one adaptation.
  struct Limits {
    /// Hysteresis of coarsening: largest edge over the allowed one [-], < 1.
    double join_below = 0.7;
    /// Most bisections without closure; the rest is left to the next adaptation, coarse tetrahedra
    /// first.
    int max_bisections = 1 << 30;
  };

  /// @throws std::invalid_argument for quadratic tetrahedra whose edges are not straight, see
  /// firstBentTet().
  explicit NestedMesh(const TetMesh& coarse);
  ~NestedMesh();
  NestedMesh(NestedMesh&&) noexcept;
  NestedMesh& operator=(NestedMesh&&) noexcept;

  /// Whether it is the coarse mesh.
  bool isCoarse() const;
  /// The mesh at rest, without tags or data.
  const TetMesh& mesh() const;
  /// Surface triangles, outward, 3 x k, as trianglesOf(boundaryFaces()).
  const Eigen::Matrix3Xi& surface() const;
  /// Coarse tetrahedron of each tetrahedron.
  const std::vector<int>& coarseTets() const;
  /// Index of `point` in the coarse mesh, or -1.
  int coarsePoint(int point) const;
  /// Midpoints, after their ends; in a quadratic mesh with the coarse mid-edge nodes.
  const std::vector<MeshChange::Middle>& middles() const;

  /// Adapts the mesh towards `size` with points at `x`, 3 x n [m]. Returns the change; null: none.
  std::unique_ptr<MeshChange> adapt(const Points& x, const Size& size, const Limits& limits);
  /// Whether the last adapt() satisfied `size`.
  bool isComplete() const;
  /// Change from the coarse mesh to this one.
  MeshChange changeFromCoarse() const;
  /// Resets to the coarse mesh.
  void coarsen();

  /// Bisected tetrahedra as bits in the order of the trees; defines the mesh with the coarse one.
  std::string bisected() const;
  /// @throws std::invalid_argument for bits of another or a nonconforming mesh.
  void restore(const std::string& bisected);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate::mesh
