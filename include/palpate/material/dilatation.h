// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/material/principal_stretches.h"
#include "palpate/material/tensor.h"

namespace palpate::material {

// Dilatation measures theta(F): zero at rest, to first order the trace of the strain. Each law
// names the measure of its volumetric energy kappa/2 theta^2; elements against locking average it
// over neighbours. A measure is a struct with
//     static double value(const Mat3& F);
//     static Mat3 gradient(const Mat3& F);                        d theta / d F
//     static void addHessian(const Mat3& F, double s, Mat9* K);   K += s d2 theta / d vec F^2

/// theta = J - 1, J = det F: the measure of finite strains.
struct VolumeRatio {
  static double value(const Mat3& F) { return F.determinant() - 1.0; }
  static Mat3 gradient(const Mat3& F) { return cofactor(F); }
  static void addHessian(const Mat3& F, double s, Mat9* K) { addCofactorDerivative(F, s, K); }
};

/// theta = tr E, E = (F^T F - I)/2: the trace of the Green strain.
struct GreenStrainTrace {
  static double value(const Mat3& F) { return 0.5 * (F.squaredNorm() - 3.0); }
  static Mat3 gradient(const Mat3& F) { return F; }
  static void addHessian(const Mat3&, double s, Mat9* K) { K->diagonal().array() += s; }
};

/// theta = tr eps, eps = (F + F^T)/2 - I: the trace of the small strain.
struct SmallStrainTrace {
  static double value(const Mat3& F) { return F.trace() - 3.0; }
  static Mat3 gradient(const Mat3&) { return Mat3::Identity(); }
  static void addHessian(const Mat3&, double, Mat9*) {}
};

/// theta = tr S - 3, F = R S: the trace of the stretch. Its gradient is R.
struct StretchTrace {
  static double value(const PrincipalStretches& p) { return p.s.sum() - 3.0; }
  static Mat3 gradient(const PrincipalStretches& p) { return p.rotation(); }
  static void addHessian(const PrincipalStretches& p, double s, Mat9* K) {
    addRotationDerivative(p, s, K);
  }

  static double value(const Mat3& F) { return value(principalStretches(F)); }
  static Mat3 gradient(const Mat3& F) { return gradient(principalStretches(F)); }
  static void addHessian(const Mat3& F, double s, Mat9* K) {
    addHessian(principalStretches(F), s, K);
  }
};

}  // namespace palpate::material
