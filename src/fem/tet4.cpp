// SPDX-License-Identifier: GPL-3.0-or-later
#include "tet4.h"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "psd_projection.h"

namespace palpate::fem {
namespace {

Mat3 deformation(const Points& x, const Eigen::Vector4i& t,
                 const Eigen::Matrix<double, 3, 4>& gradients) {
  Mat3 F = x.col(t[0]) * gradients.col(0).transpose();
  for (int a = 1; a < 4; ++a) F += x.col(t[a]) * gradients.col(a).transpose();
  return F;
}

// The ten upper blocks K_ab = V (d2psi/dF2 : g_a (x) g_b) from the 9 x 9 tangent.
void elementBlocks(const Mat9& tangent, const Eigen::Matrix<double, 3, 4>& g, double volume,
                   double* out) {
  Eigen::Matrix<double, 9, 12> CB;  // columns 3 b + c: tangent (e_c (x) g_b)
  for (int b = 0; b < 4; ++b) {
    CB.middleCols<3>(3 * b) = (volume * g(0, b)) * tangent.middleCols<3>(0) +
                              (volume * g(1, b)) * tangent.middleCols<3>(3) +
                              (volume * g(2, b)) * tangent.middleCols<3>(6);
  }
  for (int a = 0; a < 4; ++a) {
    for (int b = a; b < 4; ++b, out += 9) {
      Eigen::Map<Mat3> K_ab(out);
      K_ab = g(0, a) * CB.block<3, 3>(0, 3 * b) + g(1, a) * CB.block<3, 3>(3, 3 * b) +
             g(2, a) * CB.block<3, 3>(6, 3 * b);
    }
  }
}

}  // namespace

Tet4::Tet4(const TetMesh& mesh, const material::Material& material, ThreadPool* pool)
    : tets_(mesh.tets),
      nodal_volumes_(Eigen::VectorXd::Zero(mesh.numPoints())),
      material_(material),
      pool_(pool),
      scatter_(mesh.tets, static_cast<int>(mesh.numPoints())) {
  if (mesh.quadratic()) {
    throw std::invalid_argument("element tet4 needs 4-node tetrahedra; the mesh has 10-node ones");
  }
  for (Eigen::Index e = 0; e < tets_.cols(); ++e) {
    const Eigen::Vector4i t = tets_.col(e);
    Mat3 edges;
    for (int a = 0; a < 3; ++a) edges.col(a) = mesh.points.col(t[a + 1]) - mesh.points.col(t[0]);
    const double volume = edges.determinant() / 6.0;
    if (!(volume > 0.0)) {
      throw std::invalid_argument("tetrahedron " + std::to_string(e + 1) +
                                  " is inverted or has no volume");
    }
    Gradients g;
    g.rightCols<3>() = edges.inverse().transpose();
    g.col(0) = -g.rightCols<3>().rowwise().sum();
    gradients_.push_back(g);
    volumes_.push_back(volume);
    for (int a = 0; a < 4; ++a) nodal_volumes_[t[a]] += volume / 4.0;
  }
  energies_.resize(volumes_.size());
  forces_.resize(12, tets_.cols());
  blocks_.resize(90, tets_.cols());
}

double Tet4::energy(const Points& x) {
  std::visit(
      [&](const auto& law) {
        forAll(pool_, volumes_.size(), [&](std::size_t begin, std::size_t end) {
          for (std::size_t e = begin; e < end; ++e) {
            energies_[e] =
                volumes_[e] * energyDensity(law, deformation(x, tets_.col(e), gradients_[e]));
          }
        });
      },
      material_);
  return std::accumulate(energies_.begin(), energies_.end(), 0.0);
}

double Tet4::gradient(const Points& x, Points* g) {
  std::visit(
      [&](const auto& law) {
        forAll(pool_, volumes_.size(), [&](std::size_t begin, std::size_t end) {
          for (std::size_t e = begin; e < end; ++e) {
            const Mat3 F = deformation(x, tets_.col(e), gradients_[e]);
            energies_[e] = volumes_[e] * energyDensity(law, F);
            Eigen::Map<Eigen::Matrix<double, 3, 4>>(forces_.col(e).data()) =
                volumes_[e] * firstPiolaKirchhoff(law, F) * gradients_[e];
          }
        });
      },
      material_);
  scatter_.gatherNodes(forces_, pool_, g);
  return std::accumulate(energies_.begin(), energies_.end(), 0.0);
}

void Tet4::hessian(const Points& x, Tangent tangent, BlockMatrix* K) {
  std::visit(
      [&](const auto& law) {
        forAll(pool_, volumes_.size(), [&](std::size_t begin, std::size_t end) {
          for (std::size_t e = begin; e < end; ++e) {
            Mat9 C = material::tangent(law, deformation(x, tets_.col(e), gradients_[e]));
            if (tangent == Tangent::kProjected) projectToPositiveSemidefinite(&C);
            elementBlocks(C, gradients_[e], volumes_[e], blocks_.col(e).data());
          }
        });
      },
      material_);
  scatter_.gatherBlocks(blocks_, pool_, K);
}

double Tet4::minJacobian(const Points& x) const {
  double smallest = std::numeric_limits<double>::infinity();
  for (Eigen::Index e = 0; e < tets_.cols(); ++e) {
    smallest = std::min(smallest, deformation(x, tets_.col(e), gradients_[e]).determinant());
  }
  return smallest;
}

Mat3 Tet4::deformationGradient(const Points& x, int e) const {
  return deformation(x, tets_.col(e), gradients_[e]);
}

}  // namespace palpate::fem
