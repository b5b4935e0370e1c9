// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "palpate/base/thread_pool.h"
#include "palpate/fem/composition.h"
#include "palpate/fem/stiffness.h"
#include "rest_shape.h"
#include "sources.h"

namespace palpate::fem {

/// Volumetric energy of linear tetrahedra by pressures that live at nodes, so that the element
/// does not lock. With theta_e the dilatation of tetrahedron e and c_n = sum_e V_e/4 theta_e the
/// volume change around node n, the energy is 1/2 c^T M c:
///
/// kAveraged   M = diag(kappa/V_n), V_n = sum_e V_e/4: each node has the mean dilatation of its
///             tetrahedra [Bonet, Burton 1998].
/// kStabilised M^-1 = integral of N_m N_n/kappa + (N_m - mean)(N_n - mean)/mu: linear pressures,
///             stabilised by their difference from the mean [Dohrmann, Bochev 2004].
///
/// Where solids meet, a node has one pressure for each of them: pressure jumps there.
class NodalPressure {
 public:
  enum class Kind { kAveraged, kStabilised };
  using Gradients = Eigen::Matrix<double, 12, Eigen::Dynamic>;

  /// `kappa`: the bulk modulus that takes part, of each solid [Pa]; one that is zero stays out.
  NodalPressure(Kind kind, const std::vector<double>& kappa, const RestShape<4>& shape,
                const Composition& composition);

  /// Takes the dilatations theta_e; all that follows is about them.
  void setDilatations(const std::vector<double>& theta, ThreadPool* pool);
  /// The same in parts: all volume changes c_n become zero, the caller adds V_e/4 theta_e to
  /// those of the corners, and then the pressures follow.
  double* clearVolumeChanges();
  void updatePressures() { metric_->apply(c_, &p_); }
  const Eigen::VectorXd& pressures() const { return p_; }
  /// Number of the pressure at corner `a` of element `e`.
  int cornerPressure(int e, int a) const { return pressure_(a, e); }
  /// Entry of the node of corner `b` of that element in the row of that pressure.
  int rowEntry(int e, int a, int b) const { return entry_(4 * a + b, e); }
  /// Sets the entry of each row's own node to minus the sum of the others: a shift of all nodes
  /// changes no volume. The entries were zero.
  void completeRows(ThreadPool* pool, VolumeStiffness* stiffness) const;
  double energy() const { return 0.5 * c_.dot(p_); }
  void addEnergyBySolid(Eigen::VectorXd* energies) const;
  /// Pressure [Pa], positive in tension: mean of element `e`, and at barycentric `w` of it.
  double mean(std::size_t e) const { return at(e, Eigen::Vector4d::Constant(0.25)); }
  double at(std::size_t e, const Eigen::Vector4d& w) const;

  /// With rows of zeros.
  VolumeStiffness makeStiffness() const;
  /// Before the first call of gatherRows(): lists what goes where.
  void prepareRows();
  /// Rows of B from the gradients V_e/4 d theta_e/dx, 12 x m.
  void gatherRows(const Gradients& gradients, ThreadPool* pool, VolumeStiffness* stiffness) const;

 private:
  void numberPressures(const RestShape<4>& shape, const Composition& composition);
  void buildRows(const RestShape<4>& shape);
  int ownCorner(int e, int n) const;

  Eigen::Matrix4Xi pressure_;                     // of the element's corners
  Eigen::Matrix<int, 16, Eigen::Dynamic> entry_;  // in the row of corner a of corner b, [4 a + b]
  std::vector<int> solid_;                        // of each pressure
  std::vector<int> own_entry_;                    // of each pressure: that of its node in its row
  Sources<int> elements_;                         // around each pressure
  std::vector<double> volume_;                    // V_e [m^3]
  std::shared_ptr<const PressureMetric> metric_;
  std::shared_ptr<VolumeStiffness::Pattern> pattern_;
  Sources<int> row_sources_;  // of each entry of the pattern, into columns of 3 gradients
  Eigen::VectorXd c_, p_;     // [m^3], [Pa]
};

}  // namespace palpate::fem
