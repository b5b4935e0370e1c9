// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/bem/surface_stiffness.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "palpate/base/for_all.h"
#include "surface_operators.h"
#include "tiled_cholesky.h"

namespace palpate::bem {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

// Least Cholesky pivot over its largest possible value.
constexpr double kLeastDiagonalRatio = 1e-7;

// Triangles around a point, and the index of their corner there.
struct Corner {
  Index triangle;
  int corner;
};
using Fans = std::vector<std::vector<Corner>>;

void check(const mesh::SurfaceMesh& surface, const std::vector<Triangle>& triangles,
           const material::Moduli& moduli) {
  if (surface.points.cols() > kMaxSurfacePoints) {
    throw std::invalid_argument(
        "the surface has " + std::to_string(surface.points.cols()) + " points, and at most " +
        std::to_string(kMaxSurfacePoints) +
        " are solved for by boundary elements, whose matrices are dense (0.6 GB); enlarge "
        "edge_length, or take finite elements");
  }
  if (!(moduli.mu > 0.0 && moduli.kappa > 0.0)) {
    throw std::invalid_argument("boundary elements need positive moduli");
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!(triangles[t].area > 0.0)) {
      throw std::invalid_argument("triangle " + std::to_string(t) + " of the surface has no area");
    }
  }
}

// n_j d_i - n_i d_j of a corner's linear function, as row i, column j.
Mat3 turning(const Triangle& t, int corner) {
  const Vec3 g = t.gradients.col(corner);
  return g * t.normal.transpose() - t.normal * g.transpose();
}

// n x gradient of a corner's linear function.
Vec3 curl(const Triangle& t, int corner) { return t.normal.cross(Vec3(t.gradients.col(corner))); }

class Assembly {
 public:
  Assembly(const mesh::SurfaceMesh& surface, const std::vector<Triangle>& triangles,
           const material::Moduli& moduli, ThreadPool* pool)
      : triangles_(triangles),
        mu_(moduli.mu),
        pool_(pool),
        n_(surface.points.cols()),
        m_(surface.triangles.cols()),
        fans_(static_cast<std::size_t>(n_)),
        of_(surfaceOperators(surface, triangles, moduli, pool)) {
    for (Index t = 0; t < m_; ++t) {
      for (int a = 0; a < 3; ++a) {
        fans_[static_cast<std::size_t>(surface.triangles(a, t))].push_back({t, a});
      }
    }
  }

  SurfaceStiffness make() {
    layCurls();
    layTurnings();
    MatrixXd S = hypersingular();
    addDoubleLayer();
    if (!factorise(&of_.single_layer, pool_)) {
      throw std::invalid_argument("the surface is too irregular for boundary elements");
    }
    solveLower(of_.single_layer, &H_, pool_);
    addSquare(H_, &S, pool_);
    S.triangularView<Eigen::StrictlyUpper>() = S.transpose();
    return {std::move(S), 0.0, of_.skew};
  }

 private:
  template <class Body>
  void forPoints(const Body& body) const {
    forAll(pool_, static_cast<std::size_t>(n_), [&](std::size_t begin, std::size_t end) {
      for (std::size_t b = begin; b < end; ++b) body(static_cast<Index>(b), fans_[b]);
    });
  }
  const Triangle& triangle(const Corner& c) const {
    return triangles_[static_cast<std::size_t>(c.triangle)];
  }

  // Potential of 1/r of the curls of the points' functions, by component: m x n.
  void layCurls() {
    for (MatrixXd& E : E_) E.setZero(m_, n_);
    forPoints([&](Index b, const std::vector<Corner>& fan) {
      for (const Corner& c : fan) {
        const Vec3 w = curl(triangle(c), c.corner);
        for (int q = 0; q < 3; ++q) E_[q].col(b) += w[q] * of_.inverse.col(c.triangle);
      }
    });
  }

  // V times the turnings of the points' functions: 3 m x 3 n.
  void layTurnings() {
    H_.setZero(3 * m_, 3 * n_);
    forPoints([&](Index b, const std::vector<Corner>& fan) {
      for (const Corner& c : fan) {
        const Mat3 M = turning(triangle(c), c.corner);
        H_.middleCols<3>(3 * b).noalias() +=
            of_.single_layer.middleCols<3>(3 * c.triangle).lazyProduct(M);
      }
    });
  }

  // D = mu (4 tr(W) I - W - 2 W^T) - 4 mu^2 M^T V M, with W the tested potential of the curls; this
  // combines Han's three terms.
  MatrixXd hypersingular() const {
    MatrixXd D(3 * n_, 3 * n_);
    forPoints([&](Index b, const std::vector<Corner>&) {
      for (Index a = 0; a < n_; ++a) {
        Mat3 W = Mat3::Zero(), MVM = Mat3::Zero();
        for (const Corner& c : fans_[static_cast<std::size_t>(a)]) {
          const Index t = c.triangle;
          W += curl(triangle(c), c.corner) *
               Eigen::RowVector3d(E_[0](t, b), E_[1](t, b), E_[2](t, b));
          MVM += turning(triangle(c), c.corner).transpose() * H_.block<3, 3>(3 * t, 3 * b);
        }
        D.block<3, 3>(3 * a, 3 * b) =
            mu_ * (4.0 * W.trace() * Mat3::Identity() - W - 2.0 * W.transpose()) -
            4.0 * mu_ * mu_ * MVM;
      }
    });
    return D;
  }

  // V turnings become M/2 + K = M/2 + (K of 1/r) - (V of 1/r) turnings + 2 mu V turnings.
  void addDoubleLayer() {
    forPoints([&](Index b, const std::vector<Corner>& fan) {
      auto H = H_.middleCols<3>(3 * b);
      H *= 2.0 * mu_;
      for (Index t = 0; t < m_; ++t) {
        Mat3 block = of_.double_layer(t, b) * Mat3::Identity();
        const Vec3 e(E_[0](t, b), E_[1](t, b), E_[2](t, b));
        block += (Mat3() << 0.0, e[2], -e[1], -e[2], 0.0, e[0], e[1], -e[0], 0.0).finished();
        H.middleRows<3>(3 * t) += block;
      }
      for (const Corner& c : fan) {
        H.middleRows<3>(3 * c.triangle) += triangle(c).area / 6.0 * Mat3::Identity();
      }
    });
  }

  const std::vector<Triangle>& triangles_;
  double mu_;
  ThreadPool* pool_;
  Index n_, m_;
  Fans fans_;
  SurfaceOperators of_;
  MatrixXd E_[3], H_;
};

// Three translations and three rotations about the centre, orthonormal: 3 n x 6.
MatrixXd rigidMotions(const Points& X) {
  const Index n = X.cols();
  const Vec3 middle = X.rowwise().mean();
  const double size = (X.colwise() - middle).colwise().norm().maxCoeff();
  MatrixXd R(3 * n, 6);
  for (Index i = 0; i < n; ++i) {
    const Vec3 r = (X.col(i) - middle) / size;
    R.block<3, 3>(3 * i, 0).setIdentity();
    R.block<3, 3>(3 * i, 3) << 0.0, r.z(), -r.y(), -r.z(), 0.0, r.x(), r.y(), -r.x(), 0.0;
  }
  return Eigen::HouseholderQR<MatrixXd>(R).householderQ() * MatrixXd::Identity(3 * n, 6);
}

// S <- P S P with P = 1 - R R^T.
void takeOutRigid(const Points& X, SurfaceStiffness* made) {
  MatrixXd& S = made->matrix;
  const MatrixXd R = rigidMotions(X), SR = S * R;
  made->rigid = SR.cwiseAbs().maxCoeff() / (S.diagonal().maxCoeff() * R.cwiseAbs().maxCoeff());
  const MatrixXd left = SR - 0.5 * R * (R.transpose() * SR);
  S -= left * R.transpose() + R * left.transpose();
  S = 0.5 * (S + S.transpose()).eval();
}

}  // namespace

SurfaceStiffness surfaceStiffness(const mesh::SurfaceMesh& surface, const material::Moduli& moduli,
                                  ThreadPool* pool) {
  const std::vector<Triangle> triangles = trianglesOf(surface);
  check(surface, triangles, moduli);
  SurfaceStiffness made = Assembly(surface, triangles, moduli, pool).make();
  if (mesh::enclosedVolume(surface) > 0.0) takeOutRigid(surface.points, &made);
  return made;
}

MatrixXd surfaceCompliance(const MatrixXd& stiffness, const Eigen::Matrix3Xd& free,
                           ThreadPool* pool) {
  MatrixXd K = stiffness;
  const double unit = stiffness.diagonal().maxCoeff();
  const auto held = [&](Index k) { return free.data()[k] == 0.0; };
  for (Index k = 0; k < K.rows(); ++k) {
    if (!held(k)) continue;
    K.row(k).setZero();
    K.col(k).setZero();
    K(k, k) = unit;
  }
  if (!factorise(&K, pool) || !(K.diagonal().minCoeff() > kLeastDiagonalRatio * std::sqrt(unit))) {
    throw std::invalid_argument("what is held leaves the surface a motion");
  }
  MatrixXd root = MatrixXd::Identity(K.rows(), K.cols());
  solveLower(K, &root, pool);
  K.setZero();
  addSquare(root, &K, pool);
  for (Index k = 0; k < K.rows(); ++k) {
    if (!held(k)) continue;
    K.row(k).setZero();
    K.col(k).setZero();
  }
  K.triangularView<Eigen::StrictlyUpper>() = K.transpose();
  return K;
}

Points tractionForces(const mesh::SurfaceMesh& surface, const Points& tractions) {
  Points f = Points::Zero(3, surface.points.cols());
  const std::vector<Triangle> triangles = trianglesOf(surface);
  for (Index t = 0; t < surface.triangles.cols(); ++t) {
    const Vec3 third = triangles[static_cast<std::size_t>(t)].area / 3.0 * tractions.col(t);
    for (int a = 0; a < 3; ++a) f.col(surface.triangles(a, t)) += third;
  }
  return f;
}

Points bodyForces(const mesh::SurfaceMesh& surface, const material::Moduli& moduli,
                  const MatrixXd& stiffness, const Vec3& f) {
  const Points& X = surface.points;
  if (f.isZero(0.0)) return Points::Zero(3, X.cols());
  const Vec3 e = f.normalized(), middle = 0.5 * (X.rowwise().maxCoeff() + X.rowwise().minCoeff());
  const double P = moduli.lambda() + 2.0 * moduli.mu, side = moduli.lambda() / P;
  const Eigen::RowVectorXd z = e.transpose() * (X.colwise() - middle);
  const Points w = -f.norm() / (2.0 * P) * e * z.cwiseAbs2();
  const Eigen::VectorXd force = stiffness * Eigen::Map<const Eigen::VectorXd>(w.data(), w.size());
  Points nodal = Eigen::Map<const Points>(force.data(), 3, X.cols());
  // The stress of w is -|f| z (e e^T + side (1 - e e^T)), linear on each triangle.
  const std::vector<Triangle> triangles = trianglesOf(surface);
  for (Index t = 0; t < surface.triangles.cols(); ++t) {
    const Triangle& of = triangles[static_cast<std::size_t>(t)];
    const Vec3 n = of.normal;
    const Vec3 traction = -f.norm() * (side * n + (1.0 - side) * e.dot(n) * e);
    double sum = 0.0;
    for (int a = 0; a < 3; ++a) sum += z[surface.triangles(a, t)];
    for (int a = 0; a < 3; ++a) {
      const int node = surface.triangles(a, t);
      nodal.col(node) -= of.area / 12.0 * (sum + z[node]) * traction;
    }
  }
  return nodal;
}

}  // namespace palpate::bem
