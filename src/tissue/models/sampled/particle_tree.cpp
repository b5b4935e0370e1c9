// SPDX-License-Identifier: GPL-3.0-or-later
#include "particle_tree.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "palpate/base/number.h"
#include "palpate/base/state_bytes.h"

namespace palpate::tissue {
namespace {

constexpr double kMostCells = 3e7;

}  // namespace

ParticleTree::ParticleTree(const mesh::TetMesh& mesh_W, const Pose& X_WO, double coarsest,
                           int levels)
    : levels_(levels), finest_(coarsest / (1 << (levels - 1))), X_OW_(X_WO.inverse()) {
  mesh::TetMesh mesh = mesh_W;
  mesh.points = (X_OW_ * mesh.points.colwise().homogeneous()).eval();
  const Vec3 low = mesh.points.rowwise().minCoeff(), high = mesh.points.rowwise().maxCoeff();
  const int widest = 1 << (levels - 1);
  Vec3 counts;
  for (int k = 0; k < 3; ++k) {
    counts[k] = std::max(1.0, std::round((high[k] - low[k]) / coarsest));
    cells_[k] = static_cast<int>(counts[k]) * widest;
  }
  if (counts.prod() * std::pow(widest, 3) > kMostCells) {
    throw std::invalid_argument("sampling.coarsest = " + formatNumber(coarsest) +
                                ": the smallest cubes, which are " + formatNumber(finest_) +
                                " m, would be more than " + formatNumber(kMostCells));
  }
  // The cubes' middle is the organ's: what does not fill them is as much on both sides.
  origin_ = 0.5 * (low + high) - 0.5 * finest_ * cells_.cast<double>();
  inside_.assign(static_cast<std::size_t>(cells_.prod()), 0);
  fill(mesh, &inside_);
  owner_.assign(inside_.size(), -1);
  for (int z = 0; z < cells_.z(); z += widest) {
    for (int y = 0; y < cells_.y(); y += widest) {
      for (int x = 0; x < cells_.x(); x += widest) add({x, y, z}, 0, -1, inside_);
    }
  }
  if (particles_.empty()) {
    throw std::invalid_argument(
        "sampling.coarsest = " + formatNumber(coarsest) +
        ": must be less than the organ's thickness; no cube's middle is in it");
  }
  double volume = 0.0, organ = 0.0;
  for (const Particle& p : particles_) volume += p.level == 0 ? p.volume : 0.0;
  for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
    organ += mesh::signedVolume(mesh.points, mesh.tets.col(t));
  }
  for (Particle& p : particles_) {
    p.volume *= organ / volume;
    p.X = X_WO * p.X;
  }
  reset();
}

// Marks the smallest cubes whose middles are in a tetrahedron.
void ParticleTree::fill(const mesh::TetMesh& mesh, std::vector<char>* inside) const {
  for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
    Mat3 edges;
    Eigen::AlignedBox3d box;
    const Vec3 a = mesh.points.col(mesh.tets(0, t));
    box.extend(a);
    for (int k = 0; k < 3; ++k) {
      const Vec3 b = mesh.points.col(mesh.tets(k + 1, t));
      edges.col(k) = b - a;
      box.extend(b);
    }
    const Mat3 inverse = edges.inverse();
    Eigen::Vector3i first, last;
    for (int k = 0; k < 3; ++k) {
      first[k] = std::max(0, static_cast<int>(std::floor((box.min()[k] - origin_[k]) / finest_)));
      last[k] = std::min(cells_[k] - 1,
                         static_cast<int>(std::floor((box.max()[k] - origin_[k]) / finest_)));
    }
    for (int z = first.z(); z <= last.z(); ++z) {
      for (int y = first.y(); y <= last.y(); ++y) {
        for (int x = first.x(); x <= last.x(); ++x) {
          const Vec3 p = origin_ + finest_ * (Vec3(x, y, z).array() + 0.5).matrix();
          const Vec3 w = inverse * (p - a);
          if (w.minCoeff() >= -1e-9 && w.sum() <= 1.0 + 1e-9) {
            (*inside)[static_cast<std::size_t>(cellAt({x, y, z}))] = 1;
          }
        }
      }
    }
  }
}

template <class Visit>
void ParticleTree::forCells(const Particle& p, const Visit& visit) const {
  const int n = span(p);
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const Eigen::Vector3i c = p.low + Eigen::Vector3i(x, y, z);
        const auto cell = static_cast<std::size_t>(cellAt(c));
        if (inside_[cell]) visit(cell, c);
      }
    }
  }
}

// A particle and all below it; siblings follow one another. -1: its cube has nothing of the organ.
int ParticleTree::add(const Eigen::Vector3i& low, int level, int parent,
                      const std::vector<char>& inside) {
  Particle particle{Vec3::Zero(), 0.0, finest_ * (1 << (levels_ - 1 - level)), level, parent, -1, 0,
                    low};
  int count = 0;
  forCells(particle, [&](std::size_t, const Eigen::Vector3i& c) {
    particle.X += origin_ + finest_ * (c.cast<double>().array() + 0.5).matrix();
    ++count;
  });
  if (count == 0) return -1;
  particle.X /= count;
  particle.volume = count * std::pow(finest_, 3);
  const int self = static_cast<int>(particles_.size());
  particles_.push_back(particle);
  if (level + 1 == levels_ || parent >= 0) return self;
  // Level by level, so that siblings follow one another.
  std::vector<int> row{self};
  for (int below = 1; below < levels_; ++below) {
    std::vector<int> next;
    const int half = 1 << (levels_ - 1 - below);
    for (const int p : row) {
      const Eigen::Vector3i corner = particles_[static_cast<std::size_t>(p)].low;
      for (int k = 0; k < 8; ++k) {
        const Eigen::Vector3i at = corner + half * Eigen::Vector3i(k & 1, k >> 1 & 1, k >> 2);
        const int child = add(at, below, p, inside);
        if (child < 0) continue;
        Particle& above = particles_[static_cast<std::size_t>(p)];
        if (above.num_children++ == 0) above.first_child = child;
        next.push_back(child);
      }
    }
    row.swap(next);
  }
  return self;
}

void ParticleTree::own(int particle) {
  leaf_[static_cast<std::size_t>(particle)] = 1;
  forCells(particles_[static_cast<std::size_t>(particle)],
           [&](std::size_t cell, const Eigen::Vector3i&) { owner_[cell] = particle; });
}

void ParticleTree::reset() {
  leaf_.assign(particles_.size(), 0);
  for (std::size_t p = 0; p < particles_.size(); ++p) {
    if (particles_[p].level == 0) own(static_cast<int>(p));
  }
}

std::vector<int> ParticleTree::leafList() const {
  std::vector<int> list;
  for (std::size_t p = 0; p < leaf_.size(); ++p) {
    if (leaf_[p]) list.push_back(static_cast<int>(p));
  }
  return list;
}

void ParticleTree::refine(int leaf, std::vector<int>* parted) {
  const int level = particles_[static_cast<std::size_t>(leaf)].level;
  for (const int n : neighbours(leaf)) {
    if (leaf_[static_cast<std::size_t>(n)] && particles_[static_cast<std::size_t>(n)].level < level)
      refine(n, parted);
  }
  const Particle& particle = particles_[static_cast<std::size_t>(leaf)];
  leaf_[static_cast<std::size_t>(leaf)] = 0;
  for (int k = 0; k < particle.num_children; ++k) own(particle.first_child + k);
  parted->push_back(leaf);
}

bool ParticleTree::canCoarsen(int parent) const {
  const Particle& particle = particles_[static_cast<std::size_t>(parent)];
  for (int k = 0; k < particle.num_children; ++k) {
    const int child = particle.first_child + k;
    if (!leaf_[static_cast<std::size_t>(child)]) return false;
    for (const int n : neighbours(child)) {
      if (particles_[static_cast<std::size_t>(n)].level > particle.level + 1) return false;
    }
  }
  return particle.num_children > 0;
}

void ParticleTree::coarsen(int parent) {
  const Particle& particle = particles_[static_cast<std::size_t>(parent)];
  for (int k = 0; k < particle.num_children; ++k) {
    leaf_[static_cast<std::size_t>(particle.first_child + k)] = 0;
  }
  own(parent);
}

void ParticleTree::setLeaves(const std::vector<char>& leaves) {
  if (leaves.size() != particles_.size()) StateReader::fail();
  leaf_ = leaves;
  std::fill(owner_.begin(), owner_.end(), -1);
  for (std::size_t p = 0; p < leaf_.size(); ++p) {
    if (leaf_[p]) own(static_cast<int>(p));
  }
  for (std::size_t cell = 0; cell < inside_.size(); ++cell) {
    if (inside_[cell] && owner_[cell] < 0) StateReader::fail();
  }
}

std::vector<int> ParticleTree::neighbours(int leaf) const {
  const Particle& particle = particles_[static_cast<std::size_t>(leaf)];
  const int n = span(particle);
  std::vector<int> found;
  for (int z = -1; z <= n; ++z) {
    for (int y = -1; y <= n; ++y) {
      for (int x = -1; x <= n; ++x) {
        const int outside = (x < 0 || x == n) + (y < 0 || y == n) + (z < 0 || z == n);
        if (outside == 0 || outside == 3) continue;  // inside, or at a corner
        const int cell = cellAt(particle.low + Eigen::Vector3i(x, y, z));
        if (cell < 0) continue;
        const int owner = owner_[static_cast<std::size_t>(cell)];
        if (owner >= 0) found.push_back(owner);
      }
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

int ParticleTree::leafAt(const Vec3& p) const {
  const Vec3 p_O = X_OW_ * p;
  Eigen::Vector3i c;
  for (int k = 0; k < 3; ++k) {
    c[k] =
        std::clamp(static_cast<int>(std::floor((p_O[k] - origin_[k]) / finest_)), 0, cells_[k] - 1);
  }
  const int here = owner_[static_cast<std::size_t>(cellAt(c))];
  if (here >= 0) return here;
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < leaf_.size(); ++k) {
    if (!leaf_[k]) continue;
    const double distance = (particles_[k].X - p).squaredNorm();
    if (distance < least) {
      least = distance;
      best = static_cast<int>(k);
    }
  }
  return best;
}

}  // namespace palpate::tissue
