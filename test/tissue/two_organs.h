// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "dented_block.h"
#include "palpate/mesh/used_points.h"
#include "palpate/tissue/model_list.h"
#include "slab.h"
#include "support/repulsion.h"

namespace palpate::test {

/// An organ of a scene with several, as code says it.
struct OrganSketch {
  std::string name;
  mesh::TetMesh mesh;  ///< In the world.
  fem::FreeMask free;
  std::function<bool(const Vec3&)> held;  ///< The same for points of another mesh; empty: none.
  std::string element = fem::elementNames().front();
  solver::RayleighDamping damping{5.0, 0.0};
  tissue::AdaptSettings adapt;
  tissue::SpringSettings springs;
  tissue::ClothSettings cloth;
  tissue::SamplingSettings sampling;
  tissue::HoneycombSettings honeycomb;
  tissue::HybridSettings hybrid;
  tissue::EnrichedSettings enriched;
  tissue::NeuralSettings neural;
  material::Solid solid{kLiver, 1060.0, {}};
  Pose X_WO = Pose::Identity();  ///< Of model cloth, whose points `held` gets in its frame.

  tissue::OrganDescription describe() const {
    tissue::OrganDescription organ;
    organ.name = name;
    organ.element = element;
    organ.damping = damping;
    organ.adapt = adapt;
    organ.springs = springs;
    organ.cloth = cloth;
    organ.X_WO = X_WO;
    organ.sampling = sampling;
    organ.honeycomb = honeycomb;
    organ.hybrid = hybrid;
    organ.enriched = enriched;
    organ.deformations = [this] { return dentedBlock(mesh); };
    organ.neural = neural;
    organ.tetrahedra = [this] { return mesh; };
    organ.surface_elements = [this] {
      return mesh::onlyUsedPoints({mesh.points, mesh::trianglesOf(mesh::boundaryFaces(mesh))});
    };
    organ.free = [this](const Points& X) {
      if (X.cols() == mesh.numPoints() && X == mesh.points) return free;
      fem::FreeMask mask = fem::FreeMask::Ones(3, X.cols());
      for (Eigen::Index i = 0; held && i < X.cols(); ++i) {
        if (held(Vec3(X.col(i)))) mask.col(i).setZero();
      }
      return mask;
    };
    organ.surroundings = [of = organ.free](const mesh::TetMesh& m) {
      return tissue::Surroundings(of(m.points));
    };
    organ.composition = [this](const mesh::TetMesh&) { return fem::Composition{{solid}, {}, {}}; };
    organ.solid = [this] { return solid; };
    return organ;
  }
};

/// A block from `low`, of which `held(X)` says which nodes are held.
template <class Held>
OrganSketch block(const std::string& name, const Vec3& low, const Vec3& size,
                  const Eigen::Vector3i& cells, const Held& held) {
  OrganSketch organ;
  organ.name = name;
  organ.mesh = mesh::boxMesh(size, cells);
  organ.mesh.points.colwise() += low;
  organ.held = held;
  organ.free = fem::FreeMask::Ones(3, organ.mesh.numPoints());
  for (Eigen::Index i = 0; i < organ.mesh.numPoints(); ++i) {
    if (held(Vec3(organ.mesh.points.col(i)))) organ.free.col(i).setZero();
  }
  return organ;
}

/// Two blocks 50 x 50 x 30 mm on a table, side by side along x with a gap [m] between them, held at
/// their bottoms. Where they are at rest does not depend on the gap.
inline std::vector<OrganSketch> twoBlocks(double gap, int finer = 1) {
  const auto bottom = [](const Vec3& X) { return X.z() <= 0.0; };
  const Vec3 size(0.05, 0.05, 0.03);
  const Eigen::Vector3i cells(4 * finer, 4 * finer, 3 * finer);
  return {block("left", Vec3::Zero(), size, cells, bottom),
          block("right", Vec3(0.05 + gap, 0.0, 0.0), size, cells, bottom)};
}

inline tissue::ModelSettings organSettings() {
  tissue::ModelSettings settings;
  settings.gravity = Vec3(0.0, 0.0, -9.81);
  settings.sample_spacing = 0.004;
  settings.interactions = {repulsion<0>()};
  return settings;
}

inline std::unique_ptr<tissue::TissueModel> makeOrgans(const std::vector<OrganSketch>& organs,
                                                       const tissue::ModelSettings& settings,
                                                       ThreadPool* pool = nullptr,
                                                       const std::string& model = "fem") {
  tissue::ModelDescription description;
  for (const OrganSketch& organ : organs) description.organs.push_back(organ.describe());
  description.settings = settings;
  description.pool = pool;
  return tissue::makeModel(model, description);
}

/// Balls of 8 mm that begin 10 mm to the side of blocks or above them, and go at 40 mm/s.
class Balls {
 public:
  /// From `at` along `direction`, for `turn` [s], and then back.
  void add(const Vec3& at, const Vec3& direction, double turn) {
    ways_.push_back({at, direction, turn});
  }
  std::vector<contact::Obstacle> next() {
    std::vector<contact::Obstacle> obstacles;
    for (std::size_t k = 0; k < ways_.size(); ++k) {
      obstacles.push_back({&shape_, static_cast<int>(k), at(k, t_), at(k, t_ + kStep)});
    }
    t_ += kStep;
    return obstacles;
  }
  double time() const { return t_; }
  /// As it was at a time [s].
  void setTime(double t) { t_ = t; }

 private:
  struct Way {
    Vec3 at, direction;
    double turn;
  };
  Pose at(std::size_t k, double t) const {
    const Way& way = ways_[k];
    const double s = t < way.turn ? t : 2.0 * way.turn - t;
    return Pose(Eigen::Translation3d(way.at + 0.04 * s * way.direction));
  }
  instrument::Geometry shape_ = instrument::Sphere{0.008};
  std::vector<Way> ways_;
  double t_ = 0.0;
};

/// A ball that pushes the left one of twoBlocks() 14 mm to the right, into the other one.
inline Balls pushRight(double turn = 0.6) {
  Balls balls;
  balls.add(Vec3(-0.018, 0.025, 0.024), Vec3::UnitX(), turn);
  return balls;
}

}  // namespace palpate::test
