// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid_elasticity.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "element_blocks.h"
#include "palpate/base/for_all.h"
#include "psd_projection.h"

namespace palpate::fem {
namespace {

// Least number of tetrahedra for threads: for fewer packed ones, waking a thread costs more.
template <int N>
constexpr int kWorthThreads = N == 4 ? 1500 : 300;

std::vector<int> fill(std::vector<int> solid_of, Eigen::Index num_elements) {
  solid_of.resize(static_cast<std::size_t>(num_elements), 0);
  return solid_of;
}

}  // namespace

template <int N>
SolidElasticity<N>::SolidElasticity(const TetMesh& mesh, const Composition& composition,
                                    ThreadPool* pool, const VolumeTreatment& treatment)
    : mesh_(mesh),
      composition_(composition),
      pool_(pool),
      shape_(mesh, composition),
      scatter_(shape_.nodes, static_cast<int>(mesh.numPoints())) {
  const std::vector<int> solid_of = fill(composition.solid_of, mesh.numTets());
  std::vector<double> nodal_kappa;
  for (const material::Solid& solid : composition.solids) {
    const material::Moduli moduli = material::moduli(solid.law);
    element_kappa_.push_back(treatment.elementKappa(moduli));
    nodal_kappa.push_back(moduli.kappa - element_kappa_.back());
  }
  for (std::size_t s = 0; s < composition.solids.size(); ++s) {
    groups_.push_back({static_cast<int>(s), {}});
  }
  for (std::size_t e = 0; e < solid_of.size(); ++e) {
    groups_[solid_of[e]].elements.push_back(static_cast<int>(e));
  }
  ThreadPool* worth = mesh.numTets() >= kWorthThreads<N> ? pool : nullptr;
  const auto makeHistory = [&](const std::vector<ElementRun>& runs) {
    history_ = std::make_unique<PronyHistory>(composition, runs, static_cast<int>(mesh.numTets()),
                                              kPoints, worth);
  };
  if (std::isfinite(treatment.element_modulus)) {
    pressure_ = std::make_unique<NodalPressure>(treatment.kind, nodal_kappa, shape_, composition);
  }
  if (PackedTetrahedra<N>::fits(mesh, composition)) {
    const ElementSchedule schedule = scheduleElements(mesh, composition);
    makeHistory(schedule.runs());
    packed_ = std::make_unique<PackedTetrahedra<N>>(schedule, shape_, composition, element_kappa_,
                                                    pressure_.get(), history_.get(),
                                                    scatter_.pattern(), worth);
    return;
  }
  makeHistory(groups_);
  allocate();
}

template <int N>
void SolidElasticity<N>::allocate() {
  const Eigen::Index size = shape_.nodes.cols();
  if (forces_.cols() == size) return;
  scatter_.prepare(shape_.nodes);
  if (pressure_) {
    volume_gradients_.resize(3 * N * kPoints, size);
    pressure_->prepareRows();
  }
  dilatations_.resize(static_cast<std::size_t>(kPoints * size));
  energies_.resize(static_cast<std::size_t>(size));
  forces_.resize(Eigen::NoChange, size);
  blocks_.resize(Eigen::NoChange, size);
}

template <int N>
Stiffness SolidElasticity<N>::makeMatrix() const {
  if (!pressure_) return Stiffness(scatter_.pattern());
  return Stiffness(scatter_.pattern(), pressure_->makeStiffness());
}

template <int N>
void SolidElasticity<N>::updatePressure(const Points& x) {
  allocate();
  if (!pressure_) return;
  if (packed_) packed_->forget();
  forBatches(x, [&](const Batch& batch) {
    double theta[kBatch * kPoints];
    dilatations(*batch.law, batch.points.count, batch.F, theta);
    for (int k = 0; k < batch.count; ++k) {
      std::copy_n(theta + batch.point(k, 0), kPoints,
                  dilatations_.begin() + kPoints * batch.elements[k]);
    }
  });
  pressure_->setDilatations(dilatations_, pool_);
}

template <int N>
void SolidElasticity<N>::computeEnergies(const Points& x) {
  updatePressure(x);
  forBatches(x, [&](const Batch& batch) {
    double psi[kBatch * kPoints];
    energyDensities(*batch.law, batch.points, psi);
    for (int k = 0; k < batch.count; ++k) {
      const int e = batch.elements[k];
      energies_[e] = 0.0;
      for (int q = 0; q < kPoints; ++q) {
        energies_[e] += shape_.points[e][q].volume * psi[batch.point(k, q)];
      }
    }
  });
}

template <int N>
double SolidElasticity<N>::energy(const Points& x) {
  if (packed_) return packed_->energy(x);
  computeEnergies(x);
  return std::accumulate(energies_.begin(), energies_.end(), pressure_ ? pressure_->energy() : 0.0);
}

template <int N>
Eigen::VectorXd SolidElasticity<N>::energyBySolid(const Points& x) {
  computeEnergies(x);
  Eigen::VectorXd energies = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(groups_.size()));
  for (const ElementRun& group : groups_) {
    for (int e : group.elements) energies[group.solid] += energies_[e];
  }
  if (pressure_) pressure_->addEnergyBySolid(&energies);
  return energies;
}

template <int N>
double SolidElasticity<N>::gradient(const Points& x, Points* g) {
  if (packed_) return packed_->gradient(x, g);
  updatePressure(x);
  forBatches(x, [&](const Batch& batch) {
    double psi[kBatch * kPoints];
    Mat3 P[kBatch * kPoints];
    stresses(*batch.law, batch.points, psi, P);
    for (int k = 0; k < batch.count; ++k) {
      const int e = batch.elements[k];
      energies_[e] = 0.0;
      Eigen::Map<Eigen::Matrix<double, 3, N>> forces(forces_.col(e).data());
      forces.setZero();
      for (int q = 0; q < kPoints; ++q) {
        const RestPoint<N>& point = shape_.points[e][q];
        energies_[e] += point.volume * psi[batch.point(k, q)];
        forces += point.volume * P[batch.point(k, q)] * point.gradients;
      }
    }
  });
  scatter_.gatherNodes(forces_, pool_, g);
  return std::accumulate(energies_.begin(), energies_.end(), pressure_ ? pressure_->energy() : 0.0);
}

template <int N>
void SolidElasticity<N>::hessian(const Points& x, Tangent tangent, Stiffness* K) {
  if (packed_ && tangent != Tangent::kProjected) return packed_->hessian(x, K);
  updatePressure(x);
  forBatches(x, [&](const Batch& batch) {
    Mat9 C[kBatch * kPoints];
    Mat3 theta_gradient[kBatch * kPoints];
    tangents(*batch.law, batch.points, C, pressure_ ? theta_gradient : nullptr);
    for (int k = 0; k < batch.count; ++k) {
      const int e = batch.elements[k];
      blocks_.col(e).setZero();
      for (int q = 0; q < kPoints; ++q) {
        const RestPoint<N>& point = shape_.points[e][q];
        Mat9& at = C[batch.point(k, q)];
        if (tangent == Tangent::kProjected) {
          projectToPositiveSemidefinite(batch.F[batch.point(k, q)], &at);
        }
        addElementBlocks<N>(at, point, blocks_.col(e).data());
        if (!pressure_) continue;
        Eigen::Map<Eigen::Matrix<double, 3, N>>{volume_gradients_.col(e).data() + 3 * N* q} =
            point.volume * theta_gradient[batch.point(k, q)] * point.gradients;
      }
    }
  });
  scatter_.gatherBlocks(blocks_, pool_, &K->blocks());
  if (pressure_) pressure_->gatherRows(volume_gradients_, pool_, &K->volume());
}

template <int N>
double SolidElasticity<N>::volume() const {
  return std::accumulate(shape_.volumes.begin(), shape_.volumes.end(), 0.0);
}

template <int N>
mesh::LumpedMasses SolidElasticity<N>::lumpedMasses() const {
  mesh::LumpedMasses lumped{shape_.masses, Eigen::MatrixXd(N, shape_.nodes.cols())};
  for (Eigen::Index e = 0; e < shape_.nodes.cols(); ++e) {
    const double density = composition_.solid(static_cast<int>(e)).density;
    lumped.shares.col(e) =
        density * shape_.volumes[static_cast<std::size_t>(e)] * Tetrahedron<N>::massFractions();
  }
  return lumped;
}

template class SolidElasticity<4>;
template class SolidElasticity<10>;

}  // namespace palpate::fem
