// SPDX-License-Identifier: GPL-3.0-or-later
#include "point_kernels.h"

#include <Eigen/LU>

#include "kernels/tet_batch.h"
#include "palpate/material/law_list.h"

namespace palpate::fem {
namespace {

template <class Law>
using ThetaOf = typename std::decay_t<Law>::Dilatation;

double viscousEnergy(const Mat3& H, const Mat3& F) {
  return 0.5 * (H.cwiseProduct(F.transpose() * F).sum() - H.trace());
}

void addViscousTangent(const Mat3& H, Mat9* C) {
  for (int j = 0; j < 3; ++j) {
    for (int l = 0; l < 3; ++l) C->block<3, 3>(3 * j, 3 * l).diagonal().array() += H(j, l);
  }
}

template <class Law, class Kinematics>
double energyDensity(const Law& law, const Kinematics& of_F, const PointBatch& batch, int i,
                     double theta) {
  const double psi = batch.factor * law.distortionalEnergy(of_F);
  const double viscous = batch.H ? viscousEnergy(batch.H[i], batch.F[i]) : 0.0;
  return psi + 0.5 * batch.kappa * theta * theta + viscous;
}

double pressure(const PointBatch& batch, int i, double theta) {
  return batch.kappa * theta + (batch.pressure ? batch.pressure[i] : 0.0);
}

}  // namespace

void dilatations(const material::Material& material, int count, const Mat3* F, double* theta) {
  material::visitLaw(
      [&](const auto& law) {
        for (int i = 0; i < count; ++i) theta[i] = ThetaOf<decltype(law)>::value(F[i]);
      },
      material);
}

void energyDensities(const material::Material& material, const PointBatch& batch, double* psi) {
  material::visitLaw(
      [&](const auto& law) {
        for (int i = 0; i < batch.count; ++i) {
          const auto& of_F = law.kinematics(batch.F[i]);
          psi[i] = energyDensity(law, of_F, batch, i, ThetaOf<decltype(law)>::value(of_F));
        }
      },
      material);
}

void stresses(const material::Material& material, const PointBatch& batch, double* psi, Mat3* P) {
  material::visitLaw(
      [&](const auto& law) {
        using Theta = ThetaOf<decltype(law)>;
        for (int i = 0; i < batch.count; ++i) {
          const Mat3& F = batch.F[i];
          const auto& of_F = law.kinematics(F);
          const double theta = Theta::value(of_F);
          psi[i] = energyDensity(law, of_F, batch, i, theta);
          P[i] = batch.factor * law.distortionalStress(of_F);
          P[i] += pressure(batch, i, theta) * Theta::gradient(of_F);
          if (batch.H) P[i] += F * batch.H[i];
        }
      },
      material);
}

void tangents(const material::Material& material, const PointBatch& batch, Mat9* C,
              Mat3* theta_gradient) {
  material::visitLaw(
      [&](const auto& law) {
        using Theta = ThetaOf<decltype(law)>;
        for (int i = 0; i < batch.count; ++i) {
          const auto& of_F = law.kinematics(batch.F[i]);
          C[i] = batch.factor * law.distortionalTangent(of_F);
          const Mat3 gradient = Theta::gradient(of_F);
          C[i] += batch.kappa * material::vec(gradient) * material::vec(gradient).transpose();
          Theta::addHessian(of_F, pressure(batch, i, Theta::value(of_F)), &C[i]);
          if (batch.H) addViscousTangent(batch.H[i], &C[i]);
          if (theta_gradient) theta_gradient[i] = gradient;
        }
      },
      material);
}

void distortionalStresses(const material::Material& material, int count, const Mat3* F, Mat3* S) {
  material::visitLaw(
      [&](const auto& law) {
        for (int i = 0; i < count; ++i) {
          if (!(F[i].determinant() > kNoStress)) {
            S[i].setZero();
            continue;
          }
          const Mat3 product = F[i].inverse() * law.distortionalStress(F[i]);
          S[i] = 0.5 * (product + product.transpose());
        }
      },
      material);
}

}  // namespace palpate::fem
