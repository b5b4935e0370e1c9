// SPDX-License-Identifier: GPL-3.0-or-later
#include "case_probes.h"

#include <Eigen/LU>
#include <limits>

#include "palpate/base/error.h"

namespace palpate::io {
namespace {

constexpr double kInsideTolerance = 1e-6;  // of the barycentric weights

// The tetrahedron that holds the point, and the point's weights in it.
int findTet(const mesh::TetMesh& mesh, const Vec3& p, Eigen::Vector4d* weights) {
  int best = -1;
  double smallest_of_best = -std::numeric_limits<double>::infinity();
  for (Eigen::Index e = 0; e < mesh.numTets(); ++e) {
    Eigen::Matrix4d corners;
    for (int a = 0; a < 4; ++a) corners.col(a) << mesh.points.col(mesh.tets(a, e)), 1.0;
    const Eigen::Vector4d w = corners.inverse() * p.homogeneous();
    if (w.minCoeff() > smallest_of_best) {
      smallest_of_best = w.minCoeff();
      best = static_cast<int>(e);
      *weights = w;
    }
  }
  return smallest_of_best >= -kInsideTolerance ? best : -1;
}

}  // namespace

Eigen::Matrix<double, 6, 1> cauchyStress(const material::Material& material, const Mat3& F) {
  const Mat3 P = std::visit([&](const auto& law) { return firstPiolaKirchhoff(law, F); }, material);
  const Mat3 sigma = P * F.transpose() / F.determinant();
  Eigen::Matrix<double, 6, 1> voigt;
  voigt << sigma(0, 0), sigma(1, 1), sigma(2, 2), sigma(0, 1), sigma(1, 2), sigma(2, 0);
  return voigt;
}

CaseProbes::CaseProbes(const Case& problem, const CaseModel& model) {
  for (std::size_t i = 0; i < problem.probes.size(); ++i) {
    Placed placed;
    placed.probe = problem.probes[i];
    const std::string key = "probes[" + std::to_string(i) + "]";
    if (placed.probe.point) {
      placed.tet = findTet(model.mesh(), *placed.probe.point, &placed.weights);
      if (placed.tet < 0) {
        throw InputError(problem.file, key + ".point", "", "must lie inside the mesh");
      }
    } else {
      placed.nodes = mesh::selectPoints(model.mesh().points, *placed.probe.select);
      if (placed.nodes.empty()) {
        throw InputError(problem.file, key + ".select", "", "must select at least one node");
      }
    }
    placed_.push_back(std::move(placed));
  }
}

std::vector<ProbeResult> CaseProbes::measure(const CaseModel& model, const Points& x,
                                             const Points& support_force) const {
  std::vector<ProbeResult> results;
  for (const Placed& placed : placed_) {
    ProbeResult result;
    result.name = placed.probe.name;
    if (placed.tet >= 0) {
      Vec3 u = Vec3::Zero();
      for (int a = 0; a < 4; ++a) {
        const int i = model.mesh().tets(a, placed.tet);
        u += placed.weights[a] * (x.col(i) - model.mesh().points.col(i));
      }
      result.displacement = u;
      result.cauchy_stress =
          cauchyStress(model.material(), model.elasticity().deformationGradient(x, placed.tet));
    } else {
      Wrench sum;
      for (int i : placed.nodes) {
        const Vec3 f = support_force.col(i);
        sum += Wrench{f, Vec3(x.col(i)).cross(f)};
      }
      result.force = sum.force;
      result.moment = sum.torque;
    }
    results.push_back(std::move(result));
  }
  return results;
}

std::vector<std::string> CaseProbes::columns() const {
  std::vector<std::string> columns{"t"};
  for (const Placed& placed : placed_) {
    const std::vector<std::string> point = {"ux",  "uy",  "uz",  "sxx", "syy",
                                            "szz", "sxy", "syz", "szx"};
    const std::vector<std::string> region = {"fx", "fy", "fz", "mx", "my", "mz"};
    for (const std::string& part : placed.tet >= 0 ? point : region) {
      columns.push_back(placed.probe.name + "." + part);
    }
  }
  return columns;
}

std::vector<double> CaseProbes::row(double t, const std::vector<ProbeResult>& results) {
  std::vector<double> row{t};
  const auto append = [&](const auto& v) {
    row.insert(row.end(), v->data(), v->data() + v->size());
  };
  for (const ProbeResult& r : results) {
    if (r.displacement) append(r.displacement);
    if (r.cauchy_stress) append(r.cauchy_stress);
    if (r.force) append(r.force);
    if (r.moment) append(r.moment);
  }
  return row;
}

}  // namespace palpate::io
