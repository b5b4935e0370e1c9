// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "kernels/spring_kernels.h"
#include "palpate/springs/spring_network.h"

namespace palpate::tissue {

/// Springs of a network in structure-of-arrays form, ordered by first ends, with vectorised forces.
/// Sums have a fixed order.
class SpringArrays {
 public:
  explicit SpringArrays(const springs::SpringNetwork& network, Isa isa = bestIsa());

  int size() const { return size_; }
  int a(int s) const { return a_[static_cast<std::size_t>(s)]; }
  int b(int s) const { return b_[static_cast<std::size_t>(s)]; }
  /// Force at distance u [N], derivative [N/m], energy [J].
  double force(int s, double u) const { return preload(s) + stiffness(s) * (u - length(s)); }
  double stiffness(int s) const { return stiffness_[static_cast<std::size_t>(s)]; }
  double preload(int s) const { return preload_[static_cast<std::size_t>(s)]; }
  /// Damper of the spring [N s/m].
  double damping(int s) const { return damping_[static_cast<std::size_t>(s)]; }
  double length(int s) const { return length_[static_cast<std::size_t>(s)]; }
  double energy(int s, double u) const {
    const double longer = u - length(s);
    return (preload(s) + 0.5 * stiffness(s) * longer) * longer;
  }

  /// Energy of all springs at x, 3 x n [m] [J].
  double energy(const Points& x) const;
  /// The same; g += its gradient, 3 x n [N].
  double addGradient(const Points& x, Points* g) const;
  /// Restricted to the given springs.
  void addGradient(const Points& x, const std::vector<int>& some, Points* g) const;
  /// g -= forces of dampers of the given springs at x with velocities v, 3 x n [m/s]: `ratio` [s]
  /// times the stiffness, plus the springs' own.
  void addDamping(const Points& x, const Points& v, double ratio, const std::vector<int>& some,
                  Points* g) const;
  /// Whether a spring has a damper of its own.
  bool damps() const { return damps_; }

 private:
  void measure(const Points& x) const;

  SpringKernel kernel_;
  int size_ = 0;
  // Padded to whole batches, as SpringSpan requires.
  std::vector<int> a_, b_, a3_, b3_;
  std::vector<double> stiffness_, preload_, length_, damping_;
  bool damps_ = false;
  // Buffers, a row per spring.
  mutable Eigen::MatrixX3d force_;
  mutable Eigen::VectorXd energy_;
};

}  // namespace palpate::tissue
