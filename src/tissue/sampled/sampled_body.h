// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/tissue/sampled/sampling_settings.h"
#include "particle_tree.h"
#include "surface_links.h"
#include "umbrella.h"

namespace palpate::tissue {

/// Particles that become finer where the body bends and coarser where it does not, and how far they
/// are from rest. Displacements and velocities of parts come from a linear fit to the neighbours,
/// those of a whole are its parts' means, so that momentum stays.
class SampledBody {
 public:
  /// `surface`: its points at rest, 3 x n [m]; `held`: parts of it that are held.
  SampledBody(const mesh::TetMesh& mesh, const Pose& X_WO, const Points& surface,
              const std::vector<Umbrella::Anchor>& held, const material::Moduli& moduli,
              double density, const SamplingSettings& settings);

  /// Of the leaves, one column each.
  Points d, v;             ///< [m], [m/s]
  Eigen::VectorXd masses;  ///< [kg]

  const ParticleTree& tree() const { return tree_; }
  const std::vector<int>& leaves() const { return leaves_; }
  const Umbrella& umbrella() const { return umbrella_; }
  const SurfaceLinks& surface() const { return links_; }
  /// Longest stable step of each leaf [s].
  const Eigen::VectorXd& longestSteps() const { return longest_; }
  /// The shortest of them without contact [s].
  double longestAlone() const { return alone_; }
  /// Stiffness of contact at each point of the surface, n [N/m].
  void setContactStiffness(const Eigen::VectorXd& stiffness);

  /// All of the largest, at rest.
  void reset();
  /// Parts and joins as the settings say, once; false: nothing changed.
  bool adapt();

  void save(StateWriter* out) const;
  void restore(StateReader* in);

 private:
  void rebuild();
  void part(const std::vector<int>& parted, const std::vector<Mat3>& slopes,
            std::vector<Vec3>* values) const;
  Mat3 slope(int leaf, const Points& values) const;

  ParticleTree tree_;
  Points X_surface_;
  std::vector<Umbrella::Anchor> held_;  // of no leaf
  Umbrella umbrella_;
  SurfaceLinks links_;
  SamplingSettings settings_;
  double density_;
  std::vector<int> leaves_, at_;  // at_: of each particle its place among the leaves, or -1
  Eigen::VectorXd contact_stiffness_, longest_, bends_;
  double alone_ = 0.0;
};

}  // namespace palpate::tissue
