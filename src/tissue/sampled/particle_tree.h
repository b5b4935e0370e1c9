// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::tissue {

/// Particles that stand for the cubes of an octree over an organ: of each cube that has some of it,
/// one in the middle of what it has. Those in use, the leaves, fill the organ once, and neighbours
/// differ by one level at most.
class ParticleTree {
 public:
  struct Particle {
    Vec3 X;         ///< At rest, in the world [m].
    double volume;  ///< [m^3]
    double size;    ///< Edge of its cube [m].
    int level;      ///< 0: the largest cubes.
    int parent;     ///< -1 of the largest.
    int first_child, num_children;
    Eigen::Vector3i low;  ///< Of its cube, in the smallest ones.
  };

  /// `mesh`: the organ at rest in the world; cubes lie along the axes of its own frame, so that it
  /// is parted alike however it stands. @throws std::invalid_argument if no cube has any of it.
  ParticleTree(const mesh::TetMesh& mesh, const Pose& X_WO, double coarsest, int levels);

  const std::vector<Particle>& particles() const { return particles_; }
  int levels() const { return levels_; }
  double finest() const { return finest_; }
  /// Of each particle, whether it is in use.
  const std::vector<char>& leaves() const { return leaf_; }
  /// Those in use, ascending.
  std::vector<int> leafList() const;

  /// All of the largest cubes.
  void reset();
  /// A leaf's children take its place; its neighbours that would then be two levels coarser are
  /// parted before, and all parted are added to `parted`, in order. Not for the finest.
  void refine(int leaf, std::vector<int>* parted);
  /// Whether the children of a particle are leaves and no neighbour is finer than they are.
  bool canCoarsen(int parent) const;
  void coarsen(int parent);
  /// @throws std::invalid_argument unless they could be leaves() of this tree.
  void setLeaves(const std::vector<char>& leaves);

  /// Leaves whose cubes share a face or an edge with that of a leaf, ascending.
  std::vector<int> neighbours(int leaf) const;
  /// The leaf nearest to a point of the world, by its cube.
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
