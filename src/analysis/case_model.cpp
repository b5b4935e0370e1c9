// SPDX-License-Identifier: GPL-3.0-or-later
#include "case_model.h"

#include <filesystem>
#include <stdexcept>

#include "palpate/base/error.h"
#include "palpate/base/resource.h"
#include "palpate/formats/tet_io.h"
#include "palpate/scene/composition.h"

namespace palpate::analysis {
namespace {

mesh::TetMesh readMesh(const Case& problem) {
  mesh::TetMesh mesh;
  if (problem.mesh.box) {
    mesh = mesh::boxMesh(problem.mesh.box->size, problem.mesh.box->cells);
  } else {
    try {
      mesh = formats::readTetMesh(resolveResource(
          problem.mesh.file, std::filesystem::path(problem.file).parent_path().string()));
    } catch (const std::invalid_argument& error) {
      throw InputError(problem.file, "mesh.file", problem.mesh.file, error.what());
    }
  }
  mesh.points *= problem.mesh.scale;
  return fem::meshFor(problem.element, mesh);
}

std::unique_ptr<fem::Elasticity> makeBody(const Case& problem, const mesh::TetMesh& mesh,
                                          const fem::Composition& composition, ThreadPool* pool) {
  try {
    return fem::makeElasticity(problem.element, mesh, composition, pool);
  } catch (const std::invalid_argument& error) {
    throw InputError(problem.file, "element", problem.element, error.what());
  }
}

}  // namespace

CaseModel::CaseModel(const Case& problem, ThreadPool* pool)
    : mesh_(readMesh(problem)),
      surface_(mesh::boundaryFaces(mesh_)),
      composition_(scene::composeBody(problem, mesh_, Mat3::Identity(), problem.file, "")),
      elasticity_(makeBody(problem, mesh_, composition_, pool)) {
  potential_.elasticity = elasticity_.get();
  potential_.free = fem::FreeMask::Ones(3, mesh_.numPoints());
  for (std::size_t i = 0; i < problem.boundary.size(); ++i) {
    addCondition(problem.boundary[i], "boundary[" + std::to_string(i) + "]", problem.file);
  }
  if (!problem.gravity.isZero()) {
    dead_loads_.push_back(
        std::make_unique<fem::DeadLoad>(problem.gravity * elasticity_->loadWeights().transpose()));
    potential_.terms.push_back(dead_loads_.back().get());
  }
  const std::string motions = fem::freeRigidMotions(mesh_.points, potential_.free);
  if (std::holds_alternative<StaticAnalysis>(problem.analysis) && !motions.empty()) {
    throw InputError(problem.file, "boundary", "",
                     "must hold the body in a static analysis; it leaves " + motions +
                         " free: add a displacement");
  }
}

void CaseModel::addCondition(const BoundaryCondition& condition, const std::string& key,
                             const std::string& file) {
  const std::vector<int> nodes = mesh::selectPoints(mesh_.points, condition.select);
  if (nodes.empty()) throw InputError(file, key + ".select", "", "must select at least one node");
  if (condition.holds()) {
    for (int i : nodes) {
      for (int c = 0; c < 3; ++c) {
        const bool held = !condition.displacement || (*condition.displacement)[c];
        if (held) potential_.free(c, i) = 0.0;
      }
    }
    held_.push_back({nodes, condition});
  }
  if (!condition.traction && !condition.pressure) return;
  const Eigen::MatrixXi faces = fem::selectFaces(surface_, nodes);
  if (faces.cols() == 0) {
    throw InputError(file, key + ".select", "",
                     "must select all corners of at least one boundary face for a traction or "
                     "pressure; it selects " +
                         std::to_string(nodes.size()) + " nodes but no face");
  }
  if (condition.traction) {
    dead_loads_.push_back(std::make_unique<fem::DeadLoad>(
        fem::tractionForces(mesh_.points, faces, *condition.traction)));
    potential_.terms.push_back(dead_loads_.back().get());
  }
  if (condition.pressure) {
    pressures_.push_back(std::make_unique<fem::FollowerPressure>(faces, *condition.pressure));
    potential_.terms.push_back(pressures_.back().get());
  }
}

void CaseModel::setLoadFactor(double s) {
  for (const auto& load : dead_loads_) load->setFactor(s);
  for (const auto& pressure : pressures_) pressure->setFactor(s);
}

Points CaseModel::heldPositions(double s) const {
  Points x = mesh_.points;
  for (const HeldNodes& held : held_) {
    Pose motion = Pose::Identity();
    if (held.condition.rotation) {
      const Rotation& r = *held.condition.rotation;
      motion = Eigen::Translation3d(r.origin) *
               Eigen::AngleAxisd(s * r.angle, r.axis.normalized()) *
               Eigen::Translation3d(-r.origin);
    }
    for (int i : held.nodes) {
      const Vec3 moved = motion * Vec3(mesh_.points.col(i));
      for (int c = 0; c < 3; ++c) {
        if (!held.condition.displacement) {
          x(c, i) = moved[c];
        } else if ((*held.condition.displacement)[c]) {
          x(c, i) = moved[c] + s * *(*held.condition.displacement)[c];
        }
      }
    }
  }
  return x;
}

double CaseModel::loadNorm() const {
  double sum = 0.0;
  for (const auto& load : dead_loads_) sum += load->forces().norm();
  for (const auto& pressure : pressures_) {
    Points g = Points::Zero(3, mesh_.numPoints());
    pressure->addGradient(mesh_.points, &g);
    sum += g.norm();
  }
  return sum;
}

}  // namespace palpate::analysis
