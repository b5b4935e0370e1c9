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

/// Volumetric energy of tetrahedra by pressures at their corners, which avoids locking. theta_q is
/// the dilatation at integration point q, V_q its volume, N_n the linear shape function of corner
/// n. With the volume change c_n = sum_q N_n(q) V_q theta_q, the energy is 1/2 c^T M c:
///
/// kAveraged   M = diag(kappa/V_n), V_n = sum_q N_n(q) V_q: each corner has the mean dilatation of
///             what is around it. Of linear tetrahedra [Bonet, Burton 1998]; of quadratic ones the
///             pressures of [Hood, Taylor 1974] with their mass lumped.
/// kStabilised M^-1 = integral of N_m N_n/kappa + (N_m - mean)(N_n - mean)/mu: linear pressures,
///             stabilised by their difference from the mean [Dohrmann, Bochev 2004].
///
/// Corners between solids have one pressure per solid, since pressure jumps there.
class NodalPressure {
 public:
  enum class Kind { kAveraged, kStabilised };

  /// `kappa`: bulk modulus of each solid for these pressures [Pa]; solids with 0 take no part.
  template <int N>
  NodalPressure(Kind kind, const std::vector<double>& kappa, const RestShape<N>& shape,
                const Composition& composition)
      : NodalPressure(kind, kappa, elementsOf(shape), composition) {}

  /// Sets the dilatations theta_q, all of an element consecutively, for the functions below.
  void setDilatations(const std::vector<double>& theta, ThreadPool* pool);
  /// Begins setting by parts: zeroes all c_n. The caller adds N_n(q) V_q theta_q to them and calls
  /// updatePressures().
  double* clearVolumeChanges();
  void updatePressures() { metric_->apply(c_, &p_); }
  const Eigen::VectorXd& pressures() const { return p_; }
  /// Index of the pressure at corner `a` of element `e`.
  int cornerPressure(int e, int a) const { return pressure_(a, e); }
  /// Entry of node `b` of element `e` in the row of the pressure at corner `a`.
  int rowEntry(int e, int a, int b) const { return entry_(numNodes() * a + b, e); }
  /// Sets the entry of each row's own node to minus the sum of the others, by translation
  /// invariance.
  /// @pre these entries are zero.
  void completeRows(ThreadPool* pool, VolumeStiffness* stiffness) const;
  double energy() const { return 0.5 * c_.dot(p_); }
  void addEnergyBySolid(Eigen::VectorXd* energies) const;
  /// Pressure [Pa], positive in tension, at barycentric `w` of element `e`.
  double at(std::size_t e, const Eigen::Vector4d& w) const;

  /// VolumeStiffness with the pattern, rows zero.
  VolumeStiffness makeStiffness() const;
  /// Lists the sources of each row. Must precede gatherRows().
  void prepareRows();
  /// Rows of B from the gradients V_q d theta_q/dx: one column per element, 3 numbers per node,
  /// point after point.
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
  Eigen::Matrix4Xi pressure_;   // of the corners of each element
  Eigen::MatrixXi entry_;       // of node b in the row of corner a, [numNodes() a + b]
  std::vector<int> solid_;      // of each pressure
  std::vector<int> own_entry_;  // entry of each pressure's node in its row
  Sources<int> elements_;       // elements around each pressure
  std::shared_ptr<const PressureMetric> metric_;
  std::shared_ptr<VolumeStiffness::Pattern> pattern_;
  Sources<int> row_sources_;  // per entry of the pattern: (4 element + corner) numNodes() + node
  Eigen::VectorXd c_, p_;     // volume changes [m^3], pressures [Pa]
};

}  // namespace palpate::fem
