// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/tissue/sampled/sampling_settings.h"
#include "particle_tree.h"
#include "surface_links.h"
#include "umbrella.h"

namespace palpate::tissue {

/// Adaptive particles with displacements from rest. Refinement gives children a linear fit to the
/// neighbours; coarsening gives parents the mean of their children, which conserves momentum.
class SampledBody {
 public:
  /// `surface`: rest positions, 3 x n [m]; `held`: held parts of the surface.
  SampledBody(const mesh::TetMesh& mesh, const Pose& X_WO, const Points& surface,
              const std::vector<Umbrella::Anchor>& held, const material::Moduli& moduli,
              double density, const SamplingSettings& settings);

  /// State of the leaves, a column each.
  Points d, v;             ///< [m], [m/s]
  Eigen::VectorXd masses;  ///< [kg]

  const ParticleTree& tree() const { return tree_; }
  const std::vector<int>& leaves() const { return leaves_; }
  const Umbrella& umbrella() const { return umbrella_; }
  const SurfaceLinks& surface() const { return links_; }
  /// Longest stable step of each leaf [s].
  const Eigen::VectorXd& longestSteps() const { return longest_; }
  /// Least stable step without contact [s].
  double longestAlone() const { return alone_; }
  /// Stiffness of contact at each point of the surface, n [N/m].
  void setContactStiffness(const Eigen::VectorXd& stiffness);

  /// Resets to the largest particles, at rest.
  void reset();
  /// Refines and coarsens once by the settings. Returns whether particles changed.
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
  std::vector<Umbrella::Anchor> held_;  // without leaves
  Umbrella umbrella_;
  SurfaceLinks links_;
  SamplingSettings settings_;
  double density_;
  std::vector<int> leaves_, at_;  // at_: leaf index of each particle, or -1
  Eigen::VectorXd contact_stiffness_, longest_, bends_;
  double alone_ = 0.0;
};

}  // namespace palpate::tissue
