// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "element_scatter.h"
#include "nodal_pressure.h"
#include "packed_tetrahedra.h"
#include "palpate/base/for_all.h"
#include "palpate/fem/elasticity.h"
#include "point_kernels.h"
#include "prony_history.h"
#include "rest_shape.h"

namespace palpate::fem {

/// Split of the volumetric energy kappa/2 theta^2: integration points have the lesser of kappa and
/// `element_modulus` mu, nodal pressures the rest of kappa.
struct VolumeTreatment {
  double element_modulus = std::numeric_limits<double>::infinity();  ///< In units of mu.
  NodalPressure::Kind kind = NodalPressure::Kind::kAveraged;

  double elementKappa(const material::Moduli& moduli) const {
    return std::min(moduli.kappa, element_modulus * moduli.mu);
  }
};

/// Isoparametric tetrahedra of N nodes: at each integration point F = sum_a x_a (x) g_a, g_a = grad
/// N_a at rest [Bonet, Wood 2008, sec. 9.2], optionally with pressures at the corners.
template <int N>
class SolidElasticity final : public Elasticity {
 public:
  SolidElasticity(const TetMesh& mesh, const Composition& composition, ThreadPool* pool,
                  const VolumeTreatment& treatment);

  int numNodes() const override { return static_cast<int>(shape_.masses.size()); }
  Stiffness makeMatrix() const override;
  double energy(const Points& x) override;
  double gradient(const Points& x, Points* g) override;
  void hessian(const Points& x, Tangent tangent, Stiffness* K) override;
  double minJacobian(const Points& x) override;
  double minJacobianWithin(const Points& x) override;
  std::vector<PointState> states(const Points& x,
                                 const std::vector<mesh::Location>& places) override;
  Eigen::VectorXd energyBySolid(const Points& x) override;
  double volume() const override;
  const Eigen::VectorXd& masses() const override { return shape_.masses; }
  const Eigen::VectorXd& loadWeights() const override { return shape_.load_weights; }
  mesh::LumpedMasses lumpedMasses() const override;
  bool viscous() const override { return !history_->empty(); }
  void beginStep(double h) override;
  void endStep(const Points& x) override;
  void relax(const Points& x) override;
  std::unique_ptr<ViscousState> saveViscousState() const override;
  void restoreViscousState(const ViscousState* state) override;
  void goOnFrom(const Elasticity& old, const mesh::MeshChange& change) override;
  void save(StateWriter* out) const override { history_->save(out); }
  void restore(StateReader* in) override;

 private:
  static constexpr int kPoints = RestShape<N>::kPoints;
  static constexpr int kBatch = 32 / kPoints;  // elements
  /// Deformation gradients of elements of one solid and their terms of the law; on the stack.
  struct Batch {
    int count;            // number of elements
    const int* elements;  // ascending
    const material::Material* law;
    Mat3 F[kBatch * kPoints];
    double pressure[kBatch * kPoints];
    Mat3 H[kBatch * kPoints];
    PointBatch points;

    int point(int k, int q) const { return kPoints * k + q; }
  };
  struct SavedHistory : ViscousState {
    explicit SavedHistory(const PronyHistory::State& s) : state(s) {}
    PronyHistory::State state;
  };

  Mat3 deformation(const Points& x, std::size_t e,
                   const Eigen::Matrix<double, 3, N>& gradients) const;
  /// Calls visit(batch) for all elements, in small batches of one solid.
  template <class Visit>
  void forBatches(const Points& x, const Visit& visit) const;
  /// Allocates scratch memory, which packed elements do not need.
  void allocate();
  /// Updates the nodal pressures to x for the functions below.
  void updatePressure(const Points& x);
  void computeEnergies(const Points& x);
  PointState state(const Points& x, int e, const Eigen::Vector4d& w) const;
  /// Passes the stresses at x of all viscous points to the history.
  void remember(const Points& x);
  /// Discards results that depend on the viscous memory.
  void memoryChanged();

  TetMesh mesh_;
  Composition composition_;
  ThreadPool* pool_;
  std::vector<double> element_kappa_;  // of each solid [Pa]
  RestShape<N> shape_;
  ElementScatter<N> scatter_;
  std::vector<ElementRun> groups_;           // elements of each solid
  std::unique_ptr<NodalPressure> pressure_;  // null: elements have all of kappa
  std::unique_ptr<PronyHistory> history_;
  std::unique_ptr<PackedTetrahedra<N>> packed_;  // null where there are no kernels

  std::vector<double> energies_, dilatations_;  // scratch for elements and points
  typename ElementScatter<N>::Vectors forces_;
  typename ElementScatter<N>::Blocks blocks_;
  Eigen::MatrixXd volume_gradients_;  // for NodalPressure::gatherRows()
};

// F = sum over the nodes of x (x) grad N, in registers. An Eigen matrix is stored and reloaded in
// other widths, which stalls store forwarding: four times as long in all.
template <int N>
Mat3 SolidElasticity<N>::deformation(const Points& x, std::size_t e,
                                     const Eigen::Matrix<double, 3, N>& gradients) const {
  const auto nodes = shape_.nodes.col(static_cast<Eigen::Index>(e));
  const auto point = [&](int a) { return x.data() + 3 * Eigen::Index{nodes[a]}; };
  double F[9];
  for (int k = 0; k < 9; ++k) F[k] = point(0)[k % 3] * gradients(k / 3, 0);
  for (int a = 1; a < N; ++a) {
    const double* p = point(a);
    for (int k = 0; k < 9; ++k) F[k] += p[k % 3] * gradients(k / 3, a);
  }
  return Eigen::Map<const Mat3>(F);
}

template <int N>
template <class Visit>
void SolidElasticity<N>::forBatches(const Points& x, const Visit& visit) const {
  for (const ElementRun& group : groups_) {
    const material::Material& law = composition_.solids[group.solid].law;
    const double kappa = element_kappa_[group.solid];
    const bool remembers = history_->isViscous(group.solid);
    forAll(pool_, group.elements.size(), [&](std::size_t begin, std::size_t end) {
      Batch batch;
      batch.law = &law;
      for (std::size_t at = begin; at < end; at += kBatch) {
        batch.count = static_cast<int>(std::min<std::size_t>(kBatch, end - at));
        batch.elements = group.elements.data() + at;
        for (int k = 0; k < batch.count; ++k) {
          const auto e = static_cast<std::size_t>(batch.elements[k]);
          for (int q = 0; q < kPoints; ++q) {
            const int i = batch.point(k, q);
            batch.F[i] = deformation(x, e, shape_.points[e][q].gradients);
            if (pressure_) batch.pressure[i] = pressure_->at(e, Tetrahedron<N>::point(q));
            if (remembers) batch.H[i] = history_->stress(batch.elements[k], q);
          }
        }
        batch.points = {kPoints * batch.count,
                        batch.F,
                        history_->factor(group.solid),
                        kappa,
                        pressure_ ? batch.pressure : nullptr,
                        remembers ? batch.H : nullptr};
        visit(batch);
      }
    });
  }
}

}  // namespace palpate::fem
