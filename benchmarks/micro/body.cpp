// SPDX-License-Identifier: GPL-3.0-or-later
#include "body.h"

#include <cmath>

#include "palpate/material/material.h"

namespace palpate::micro {
namespace {

constexpr double kEdge = 0.1;   // [m]
constexpr double kStep = 0.01;  // [s]

material::Material materialOf(const std::string& law) {
  if (law == "neo_hookean" || law == "stable_neo_hookean") {
    return material::makeMaterial(law, {{"young_modulus", {5.0e3}}, {"poisson_ratio", {0.45}}});
  }
  return material::makeMaterial(law, material::exampleConstants(law));
}

Vec3 deformed(const Vec3& X) {
  const Vec3 s = X / kEdge;
  const Vec3 u(0.06 * std::sin(3.0 * s.y()) * s.z(), 0.05 * s.x() * s.z(),
               -0.1 * s.z() * s.z() * (1.0 + 0.3 * std::cos(4.0 * s.x())));
  return X + kEdge * u;
}

}  // namespace

Body::Body(int n, const std::string& element, const std::string& law, ThreadPool* pool,
           const std::vector<material::PronyTerm>& prony)
    : mesh(fem::meshFor(element,
                        mesh::boxMesh(Vec3::Constant(kEdge), Eigen::Vector3i::Constant(n)))),
      elasticity(
          fem::makeElasticity(element, mesh, {{{materialOf(law), 1000.0, prony}}, {}, {}}, pool)),
      x(mesh.points) {
  for (Eigen::Index i = 0; i < x.cols(); ++i) x.col(i) = deformed(mesh.points.col(i));
}

fem::Stiffness stepMatrix(const Body& body) {
  fem::Stiffness K = body.elasticity->makeMatrix();
  body.elasticity->hessian(body.x, fem::Tangent::kProjected, &K);
  const Eigen::VectorXd& masses = body.elasticity->masses();
  fem::BlockMatrix& blocks = K.blocks();
  for (int i = 0; i < blocks.numNodes(); ++i) {
    blocks.block(blocks.diagonal(i)).diagonal().array() += masses[i] / (kStep * kStep);
  }
  return K;
}

Points pushOnTop(const Body& body) {
  Points f = Points::Zero(3, body.mesh.numPoints());
  for (Eigen::Index i = 0; i < f.cols(); ++i) {
    const Vec3 X = body.mesh.points.col(i);
    const bool patch =
        X.z() > kEdge - 1e-9 && (X.head<2>().array() - kEdge / 2).abs().maxCoeff() < 0.015;
    if (patch) f.col(i) = Vec3(0.01, 0.0, -0.1);
  }
  return f;
}

void countTets(benchmark::State& state, const Body& body) {
  state.counters["per_tet"] = benchmark::Counter(
      static_cast<double>(body.mesh.numTets()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

}  // namespace palpate::micro
