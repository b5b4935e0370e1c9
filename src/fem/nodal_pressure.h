// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "palpate/base/thread_pool.h"
#include "palpate/fem/composition.h"
#include "palpate/fem/stiffness.h"
#include "rest_shape.h"
#include "sources.h"

namespace palpate::fem {

/// Volumetric energy of tetrahedra by pressures that live at their corners, so that the element
/// does not lock. With theta_q the dilatation at integration point q, V_q its volume, N_n the
/// linear shape functions of the corners and c_n = sum_q N_n(q) V_q theta_q the volume change
/// around corner n, the energy is 1/2 c^T M c:
///
/// kAveraged   M = diag(kappa/V_n), V_n = sum_q N_n(q) V_q: each corner has the mean dilatation of
///             what is around it. Of linear tetrahedra [Bonet, Burton 1998]; of quadratic ones the
///             pressures of [Hood, Taylor 1974] with their mass lumped.
/// kStabilised M^-1 = integral of N_m N_n/kappa + (N_m - mean)(N_n - mean)/mu: linear pressures,
///             stabilised by their difference from the mean [Dohrmann, Bochev 2004].
///
/// Where solids meet, a corner has one pressure for each of them: pressure jumps there.
class NodalPressure {
 public:
  enum class Kind { kAveraged, kStabilised };

  /// `kappa`: the bulk modulus that takes part, of each solid [Pa]; one that is zero stays out.
  template <int N>
  NodalPressure(Kind kind, const std::vector<double>& kappa, const RestShape<N>& shape,
                const Composition& composition)
      : NodalPressure(kind, kappa, elementsOf(shape), composition) {}

  /// Takes the dilatations theta_q, those of an element side by side; all that follows is about
  /// them.
  void setDilatations(const std::vector<double>& theta, ThreadPool* pool);
  /// The same in parts: all volume changes c_n become zero, the caller adds N_n(q) V_q theta_q to
  /// those of the corners, and then the pressures follow.
  double* clearVolumeChanges();
  void updatePressures() { metric_->apply(c_, &p_); }
  const Eigen::VectorXd& pressures() const { return p_; }
  /// Number of the pressure at corner `a` of element `e`.
  int cornerPressure(int e, int a) const { return pressure_(a, e); }
  /// Entry of node `b` of that element in the row of that pressure.
  int rowEntry(int e, int a, int b) const { return entry_(numNodes() * a + b, e); }
  /// Sets the entry of each row's own node to minus the sum of the others: a shift of all nodes
  /// changes no volume. The entries were zero.
  void completeRows(ThreadPool* pool, VolumeStiffness* stiffness) const;
  double energy() const { return 0.5 * c_.dot(p_); }
  void addEnergyBySolid(Eigen::VectorXd* energies) const;
  /// Pressure [Pa], positive in tension, at barycentric `w` of element `e`.
  double at(std::size_t e, const Eigen::Vector4d& w) const;

  /// With rows of zeros.
  VolumeStiffness makeStiffness() const;
  /// Before the first call of gatherRows(): lists what goes where.
  void prepareRows();
  /// Rows of B from the gradients V_q d theta_q/dx: a column an element, 3 numbers a node, point
  /// after point.
  void gatherRows(const Eigen::MatrixXd& gradients, ThreadPool* pool,
                  VolumeStiffness* stiffness) const;

 private:
  struct Elements {
    Eigen::MatrixXi nodes;    // of each element, corners first
    Eigen::MatrixXd volumes;  // V_q of each element [m^3]
    Eigen::Matrix4Xd shares;  // N_n(q)
  };
  template <int N>
  static Elements elementsOf(const RestShape<N>& shape);

  NodalPressure(Kind kind, const std::vector<double>& kappa, Elements elements,
                const Composition& composition);
  void numberPressures(const Composition& composition);
  void buildRows();
  void makeAveraged(const std::vector<double>& kappa);
  void makeStabilised(const std::vector<double>& kappa, const Composition& composition);
  int ownCorner(int e, int n) const;
  int numNodes() const { return static_cast<int>(of_.nodes.rows()); }
  int numPoints() const { return static_cast<int>(of_.volumes.rows()); }

  Elements of_;
  Eigen::Matrix4Xi pressure_;   // of the element's corners
  Eigen::MatrixXi entry_;       // in the row of corner a of node b, [numNodes() a + b]
  std::vector<int> solid_;      // of each pressure
  std::vector<int> own_entry_;  // of each pressure: that of its node in its row
  Sources<int> elements_;       // around each pressure
  std::shared_ptr<const PressureMetric> metric_;
  std::shared_ptr<VolumeStiffness::Pattern> pattern_;
  Sources<int>
      row_sources_;        // of each entry of the pattern: (4 element + corner) numNodes() + node
  Eigen::VectorXd c_, p_;  // [m^3], [Pa]
};

}  // namespace palpate::fem
