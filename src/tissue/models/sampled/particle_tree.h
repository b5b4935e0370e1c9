// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::tissue {

/// Particles of an octree over an organ: one per cube with tissue, at its tissue's centroid. Leaves
/// fill the organ once; neighbours differ by at most one level.
class ParticleTree {
 public:
  struct Particle {
    Vec3 X;         ///< Rest position, world [m].
    double volume;  ///< [m^3]
    double size;    ///< Edge of the cube [m].
    int level;      ///< 0: the largest cubes.
    int parent;     ///< Index of the parent, -1 for the largest.
    int first_child, num_children;
    Eigen::Vector3i low;  ///< Low corner of the cube, in units of the smallest cubes.
  };

  /// `mesh`: the organ's rest configuration, world [m]; cubes are aligned with the organ's frame.
  /// @throws std::invalid_argument where no cube has tissue.
  ParticleTree(const mesh::TetMesh& mesh, const Pose& X_WO, double coarsest, int levels);

  const std::vector<Particle>& particles() const { return particles_; }
  int levels() const { return levels_; }
  double finest() const { return finest_; }
  /// Whether each particle is a leaf.
  const std::vector<char>& leaves() const { return leaf_; }
  /// Leaves, ascending.
  std::vector<int> leafList() const;

  /// Makes the largest cubes the leaves.
  void reset();
  /// Replaces a leaf by its children, after neighbours two levels coarser; adds all replaced ones
  /// to `parted`, in order.
  /// @pre The leaf is not of the finest level.
  void refine(int leaf, std::vector<int>* parted);
  /// Whether a particle's children are leaves without finer neighbours.
  bool canCoarsen(int parent) const;
  void coarsen(int parent);
  /// @throws std::invalid_argument for particles that cannot be leaves() of this tree.
  void setLeaves(const std::vector<char>& leaves);

  /// Neighbours of a leaf by faces or edges of cubes, ascending.
  std::vector<int> neighbours(int leaf) const;
  /// Leaf with the cube nearest to a point, world.
  int leafAt(const Vec3& p) const;

 private:
  int cellAt(const Eigen::Vector3i& c) const {
    if ((c.array() < 0).any() || (c.array() >= cells_.array()).any()) return -1;
    return c.x() + cells_.x() * (c.y() + cells_.y() * c.z());
  }
  int span(const Particle& p) const { return 1 << (levels_ - 1 - p.level); }
  template <class Visit>
  void forCells(const Particle& p, const Visit& visit) const;
  void fill(const mesh::TetMesh& mesh, std::vector<char>* inside) const;
  int add(const Eigen::Vector3i& low, int level, int parent, const std::vector<char>& inside);
  void own(int particle);

  int levels_;
  double finest_;
  Pose X_OW_;
  Vec3 origin_;  // in the organ's frame
  Eigen::Vector3i cells_;
  std::vector<Particle> particles_;
  std::vector<char> leaf_;
  std::vector<int> owner_;  // the leaf of each smallest cube, -1 outside
  std::vector<char> inside_;
};

}  // namespace palpate::tissue
