// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "palpate/mesh/mesh_change.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::mesh {

/// A mesh that is finer in places, by bisection of the tetrahedra of a coarse one: nested, so that
/// every linear field on the coarse mesh is one on the fine mesh, or every quadratic field where
/// the coarse mesh is quadratic, which the finer ones then are too; and conforming, because what a
/// bisection leaves hanging is bisected too, until nothing is. Which tetrahedra are bisected, and
/// the order of all numbers, follow from the coarse mesh and from what was asked for alone, not
/// from what the mesh was before.
class NestedMesh {
 public:
  /// How long the edges of tetrahedra whose middle is at p [m] in the deformed body are to be in
  /// the mean, at rest [m]. None gets longer than 1.6 times that.
  using Size = std::function<double(const Vec3& p)>;

  /// What limits the work of one change.
  struct Limits {
    /// Bisected tetrahedra are joined to one of which no edge gets longer than this part of what
    /// is allowed, < 1, so that a mesh does not change to and fro.
    double join_below = 0.7;
    /// As many tetrahedra are bisected anew, but for those that conformity asks for; more are left
    /// to the next change, coarse ones first.
    int max_bisections = 1 << 30;
  };

  /// @throws std::invalid_argument for quadratic tetrahedra whose edges are not straight, see
  /// firstBentTet().
  explicit NestedMesh(const TetMesh& coarse);
  ~NestedMesh();
  NestedMesh(NestedMesh&&) noexcept;
  NestedMesh& operator=(NestedMesh&&) noexcept;

  /// Whether nothing is bisected.
  bool isCoarse() const;
  /// Its points at rest, numbered as the tetrahedra name them; no tags or data.
  const TetMesh& mesh() const;
  /// Its surface, outward, 3 x k: through all nodes, as trianglesOf(boundaryFaces()).
  const Eigen::Matrix3Xi& surface() const;
  /// The tetrahedron of the coarse mesh in which each lies.
  const std::vector<int>& coarseTets() const;
  /// The point of the coarse mesh that `point` is, or -1.
  int coarsePoint(int point) const;
  /// All points that are in the middle between two others, after those; in a quadratic mesh the
  /// middle nodes of the coarse mesh, too.
  const std::vector<MeshChange::Middle>& middles() const;

  /// Brings the mesh nearer to what `size` asks for where the points are at `x`, 3 x n [m]. Returns
  /// how it changed, or nothing if it did not.
  std::unique_ptr<MeshChange> adapt(const Points& x, const Size& size, const Limits& limits);
  /// Whether the last adapt() did all that it was asked for.
  bool isComplete() const;
  /// How the coarse mesh, numbered as mesh() was then, became this one.
  MeshChange changeFromCoarse() const;
  /// Becomes the coarse mesh.
  void coarsen();

  /// Which tetrahedra are bisected, in the order of the trees: with the coarse mesh all there is to
  /// know.
  std::string bisected() const;
  /// @throws std::invalid_argument for bits of another mesh, or of one that does not conform.
  void restore(const std::string& bisected);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate::mesh
