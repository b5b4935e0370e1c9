// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid_elasticity.h"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "point_law.h"
#include "psd_projection.h"

namespace palpate::fem {
namespace {

std::vector<int> fill(std::vector<int> solid_of, Eigen::Index num_elements) {
  solid_of.resize(static_cast<std::size_t>(num_elements), 0);
  return solid_of;
}

// out += the upper blocks K_ab = V (d2psi/dF2 : g_a (x) g_b) of the 9 x 9 tangent.
template <int N>
void addElementBlocks(const Mat9& tangent, const RestPoint<N>& point, double* out) {
  const Eigen::Matrix<double, 3, N>& g = point.gradients;
  Eigen::Matrix<double, 9, 3 * N> CB;  // columns 3 b + c: tangent (e_c (x) g_b)
  for (int b = 0; b < N; ++b) {
    CB.template middleCols<3>(3 * b) =
        (point.volume * g(0, b)) * tangent.template middleCols<3>(0) +
        (point.volume * g(1, b)) * tangent.template middleCols<3>(3) +
        (point.volume * g(2, b)) * tangent.template middleCols<3>(6);
  }
  for (int a = 0; a < N; ++a) {
    for (int b = a; b < N; ++b, out += 9) {
      Eigen::Map<Mat3>{out} += g(0, a) * CB.template block<3, 3>(0, 3 * b) +
                               g(1, a) * CB.template block<3, 3>(3, 3 * b) +
                               g(2, a) * CB.template block<3, 3>(6, 3 * b);
    }
  }
}

}  // namespace

template <int N>
SolidElasticity<N>::SolidElasticity(const TetMesh& mesh, const Composition& composition,
                                    ThreadPool* pool, const VolumeTreatment& treatment)
    : mesh_(mesh),
      composition_(composition),
      pool_(pool),
      element_share_(treatment.element_share),
      shape_(mesh, composition),
      scatter_(shape_.nodes, static_cast<int>(mesh.numPoints())),
      history_(composition, static_cast<int>(mesh.numTets()), kPoints) {
  const std::vector<int> solid_of = fill(composition.solid_of, mesh.numTets());
  for (std::size_t s = 0; s < composition.solids.size(); ++s) {
    groups_.push_back({static_cast<int>(s), {}});
  }
  for (std::size_t e = 0; e < solid_of.size(); ++e) {
    groups_[solid_of[e]].elements.push_back(static_cast<int>(e));
  }
  if constexpr (N == 4) {
    if (element_share_ < 1.0) {
      pressure_ = std::make_unique<NodalPressure>(treatment.kind, 1.0 - element_share_, shape_,
                                                  composition);
      volume_gradients_.resize(12, mesh.numTets());
      dilatations_.resize(solid_of.size());
    }
  }
  energies_.resize(solid_of.size());
  forces_.resize(Eigen::NoChange, mesh.numTets());
  blocks_.resize(Eigen::NoChange, mesh.numTets());
}

template <int N>
Mat3 SolidElasticity<N>::deformation(const Points& x, std::size_t e,
                                     const Eigen::Matrix<double, 3, N>& gradients) const {
  const auto nodes = shape_.nodes.col(static_cast<Eigen::Index>(e));
  Mat3 F = x.col(nodes[0]) * gradients.col(0).transpose();
  for (int a = 1; a < N; ++a) F += x.col(nodes[a]) * gradients.col(a).transpose();
  return F;
}

template <int N>
template <class Visit>
void SolidElasticity<N>::forElements(const Visit& visit) const {
  for (const Group& group : groups_) {
    const material::Solid& solid = composition_.solids[group.solid];
    std::visit(
        [&](const auto& law) {
          forAll(pool_, group.elements.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
              visit(law, group.solid, static_cast<std::size_t>(group.elements[i]));
            }
          });
        },
        solid.law);
  }
}

template <int N>
Stiffness SolidElasticity<N>::makeMatrix() const {
  if (!pressure_) return Stiffness(scatter_.pattern());
  return Stiffness(scatter_.pattern(), pressure_->makeStiffness());
}

template <int N>
void SolidElasticity<N>::updatePressure(const Points& x) {
  if (!pressure_) return;
  forElements([&](const auto& law, int, std::size_t e) {
    using Theta = typename std::decay_t<decltype(law)>::Dilatation;
    dilatations_[e] = Theta::value(deformation(x, e, shape_.points[e][0].gradients));
  });
  pressure_->setDilatations(dilatations_, pool_);
}

template <int N>
void SolidElasticity<N>::computeEnergies(const Points& x) {
  updatePressure(x);
  forElements([&](const auto& law, int solid, std::size_t e) {
    energies_[e] = 0.0;
    for (int q = 0; q < kPoints; ++q) {
      const RestPoint<N>& point = shape_.points[e][q];
      const PointLaw<std::decay_t<decltype(law)>> at{
          law, history_.factor(solid), element_share_ * law.moduli().kappa, 0.0,
          viscous() ? &history_.stress(static_cast<int>(e), q) : nullptr};
      energies_[e] += point.volume * at.energyDensity(deformation(x, e, point.gradients));
    }
  });
}

template <int N>
double SolidElasticity<N>::energy(const Points& x) {
  computeEnergies(x);
  return std::accumulate(energies_.begin(), energies_.end(), pressure_ ? pressure_->energy() : 0.0);
}

template <int N>
Eigen::VectorXd SolidElasticity<N>::energyBySolid(const Points& x) {
  computeEnergies(x);
  Eigen::VectorXd energies = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(groups_.size()));
  for (const Group& group : groups_) {
    for (int e : group.elements) energies[group.solid] += energies_[e];
  }
  if (pressure_) pressure_->addEnergyBySolid(&energies);
  return energies;
}

template <int N>
double SolidElasticity<N>::gradient(const Points& x, Points* g) {
  updatePressure(x);
  forElements([&](const auto& law, int solid, std::size_t e) {
    energies_[e] = 0.0;
    Eigen::Map<Eigen::Matrix<double, 3, N>> forces(
        forces_.col(static_cast<Eigen::Index>(e)).data());
    forces.setZero();
    for (int q = 0; q < kPoints; ++q) {
      const RestPoint<N>& point = shape_.points[e][q];
      const PointLaw<std::decay_t<decltype(law)>> at{
          law, history_.factor(solid), element_share_ * law.moduli().kappa, pressure(e),
          viscous() ? &history_.stress(static_cast<int>(e), q) : nullptr};
      const Mat3 F = deformation(x, e, point.gradients);
      energies_[e] += point.volume * at.energyDensity(F);
      forces += point.volume * at.firstPiolaKirchhoff(F) * point.gradients;
    }
  });
  scatter_.gatherNodes(forces_, pool_, g);
  return std::accumulate(energies_.begin(), energies_.end(), pressure_ ? pressure_->energy() : 0.0);
}

template <int N>
void SolidElasticity<N>::hessian(const Points& x, Tangent tangent, Stiffness* K) {
  updatePressure(x);
  forElements([&](const auto& law, int solid, std::size_t e) {
    using Law = std::decay_t<decltype(law)>;
    const auto column = static_cast<Eigen::Index>(e);
    blocks_.col(column).setZero();
    for (int q = 0; q < kPoints; ++q) {
      const RestPoint<N>& point = shape_.points[e][q];
      const PointLaw<Law> at{law, history_.factor(solid), element_share_ * law.moduli().kappa,
                             pressure(e),
                             viscous() ? &history_.stress(static_cast<int>(e), q) : nullptr};
      const Mat3 F = deformation(x, e, point.gradients);
      Mat9 C = at.tangent(F);
      if (tangent == Tangent::kProjected) projectToPositiveSemidefinite(&C);
      addElementBlocks<N>(C, point, blocks_.col(column).data());
      if constexpr (N == 4) {
        if (!pressure_) continue;
        Eigen::Map<Eigen::Matrix<double, 3, 4>>{volume_gradients_.col(column).data()} =
            point.volume / 4.0 * Law::Dilatation::gradient(F) * point.gradients;
      }
    }
  });
  scatter_.gatherBlocks(blocks_, pool_, &K->blocks());
  if (pressure_) pressure_->gatherRows(volume_gradients_, pool_, &K->volume());
}

template <int N>
double SolidElasticity<N>::minJacobian(const Points& x) const {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < shape_.points.size(); ++e) {
    for (const RestPoint<N>& point : shape_.points[e]) {
      smallest = std::min(smallest, deformation(x, e, point.gradients).determinant());
    }
  }
  return smallest;
}

template <int N>
std::vector<PointState> SolidElasticity<N>::states(const Points& x,
                                                   const std::vector<mesh::Location>& places) {
  updatePressure(x);
  std::vector<PointState> states;
  for (const mesh::Location& at : places) states.push_back(state(x, at.tet, at.w));
  return states;
}

template <int N>
PointState SolidElasticity<N>::state(const Points& x, int e, const Eigen::Vector4d& w) const {
  Eigen::Matrix<double, 3, N> X;
  for (int a = 0; a < N; ++a) X.col(a) = mesh_.points.col(shape_.nodes(a, e));
  double determinant = 0.0;
  Eigen::Matrix<double, 3, N> gradients = RestShape<N>::gradientsAt(X, w, &determinant);
  Mat3 Q = Mat3::Identity();
  if (!composition_.frames.empty()) Q = composition_.frames[e];
  gradients = Q.transpose() * gradients;
  const Mat3 F = deformation(x, static_cast<std::size_t>(e), gradients);
  int nearest = 0;  // integration point, whose viscous memory is taken
  for (int q = 1; q < kPoints; ++q) {
    const auto distance = [&](int k) { return (Tetrahedron<N>::point(k) - w).squaredNorm(); };
    if (distance(q) < distance(nearest)) nearest = q;
  }
  const int solid = composition_.solid_of.empty() ? 0 : composition_.solid_of[e];
  const Mat3 P = std::visit(
      [&](const auto& law) -> Mat3 {
        const double p = pressure_ ? pressure_->at(static_cast<std::size_t>(e), w) : 0.0;
        const PointLaw<std::decay_t<decltype(law)>> at{
            law, history_.factor(solid), element_share_ * law.moduli().kappa, p,
            viscous() ? &history_.stress(e, nearest) : nullptr};
        return at.firstPiolaKirchhoff(F);
      },
      composition_.solids[solid].law);
  return {F * Q.transpose(), P * F.transpose() / F.determinant()};
}

template <int N>
double SolidElasticity<N>::volume() const {
  return std::accumulate(shape_.volumes.begin(), shape_.volumes.end(), 0.0);
}

template <int N>
template <class Visit>
void SolidElasticity<N>::forViscousPoints(const Points& x, const Visit& visit) const {
  if (history_.empty()) return;
  forElements([&](const auto& law, int, std::size_t e) {
    for (int q = 0; q < kPoints; ++q) {
      const Mat3 F = deformation(x, e, shape_.points[e][q].gradients);
      const Mat3 S = F.inverse() * law.distortionalStress(F);
      visit(static_cast<int>(e), q, 0.5 * (S + S.transpose()));
    }
  });
}

template <int N>
void SolidElasticity<N>::endStep(const Points& x) {
  forViscousPoints(x, [&](int e, int q, const Mat3& S) { history_.endStep(e, q, S); });
}

template <int N>
void SolidElasticity<N>::relax(const Points& x) {
  forViscousPoints(x, [&](int e, int q, const Mat3& S) { history_.relax(e, q, S); });
  history_.beginStep(std::numeric_limits<double>::infinity());
}

template <int N>
std::unique_ptr<ViscousState> SolidElasticity<N>::saveViscousState() const {
  if (history_.empty()) return nullptr;
  return std::make_unique<SavedHistory>(history_);
}

template <int N>
void SolidElasticity<N>::restoreViscousState(const ViscousState* state) {
  if (const auto* saved = dynamic_cast<const SavedHistory*>(state)) history_ = saved->history;
}

template class SolidElasticity<4>;
template class SolidElasticity<10>;

}  // namespace palpate::fem
