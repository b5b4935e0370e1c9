// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/tissue/model_list.h"

namespace palpate::test {

/// Surfaces of organs that lie still, all in one model, and whose last triangles are split into
/// three in every cycle: a mesh that changes while it runs. Each organ touches instrument 0 at its
/// first point, the k-th with k + 1 newtons.
class SplittingModel final : public tissue::TissueModel {
 public:
  explicit SplittingModel(const tissue::ModelDescription& description) {
    for (const tissue::OrganDescription& organ : description.organs) {
      Organ made;
      const mesh::SurfaceMesh surface = organ.surface();
      made.x = organ.X_WO * surface.points.colwise().homogeneous();
      made.v = Points::Zero(3, made.x.cols());
      made.triangles = surface.triangles;
      start_.push_back(made);
    }
    now_ = start_;
  }

  int numOrgans() const override { return static_cast<int>(now_.size()); }
  tissue::SurfaceState surfaceState(int organ) const override {
    const Organ& o = now_[static_cast<std::size_t>(organ)];
    return {o.x, o.v, o.triangles, revision_};
  }
  mesh::CellMesh cells(int organ) const override {
    return {now_[static_cast<std::size_t>(organ)].x, {}, {}};
  }
  const tissue::TissueStep& step(const std::vector<contact::Obstacle>&, double) override {
    out_.clear();
    for (std::size_t k = 0; k < now_.size(); ++k) {
      split(&now_[k]);
      const Vec3 force(0.0, 0.0, static_cast<double>(k) + 1.0);
      out_.contacts.push_back({0, 0.0, now_[k].x.col(0), force, static_cast<int>(k)});
      out_.support_force += force;
    }
    ++revision_;
    return out_;
  }
  void setInterrupt(const solver::Interrupt*) override {}
  void reset() override {
    now_ = start_;
    ++revision_;
  }
  void setPositions(int organ, const Points& positions, const Points& velocities) override {
    now_[static_cast<std::size_t>(organ)].x = positions;
    now_[static_cast<std::size_t>(organ)].v = velocities;
  }
  tissue::State state() const override {
    StateWriter out;
    for (const Organ& organ : now_) {
      out.put(organ.x);
      out.put(organ.v);
      out.put(organ.triangles);
    }
    return {"splitting", out.bytes()};
  }
  void restore(const tissue::State& state) override {
    tissue::checkKind(state, "splitting");
    StateReader in(state.bytes);
    for (Organ& organ : now_) {
      in.get(&organ.x);
      in.get(&organ.v);
      in.get(&organ.triangles);
    }
    in.finish();
    ++revision_;
  }

 private:
  struct Organ {
    Points x, v;
    Eigen::Matrix3Xi triangles;
  };

  static void split(Organ* organ) {
    const Eigen::Vector3i t = organ->triangles.rightCols(1);
    const Vec3 middle = (organ->x.col(t[0]) + organ->x.col(t[1]) + organ->x.col(t[2])) / 3.0;
    const Eigen::Index n = organ->x.cols(), m = organ->triangles.cols();
    organ->x.conservativeResize(3, n + 1);
    organ->x.col(n) = middle;
    organ->v = Points::Zero(3, n + 1);
    organ->triangles.conservativeResize(3, m + 2);
    for (int k = 0; k < 3; ++k) {
      organ->triangles.col(m - 1 + k) = Eigen::Vector3i(t[k], t[(k + 1) % 3], static_cast<int>(n));
    }
  }

  std::vector<Organ> start_, now_;
  std::uint64_t revision_ = 0;
  tissue::TissueStep out_;
};

/// Further lines of an organ in SlabScene::file(): it and another one, both of this model.
inline const char* const kSplittingOrgans = R"(
    model: splitting
  - name: other
    tetrahedra: slab.vtu
    pose: {position: [0.2, -0.05, 0]}
    model: splitting
    material: {law: stable_neo_hookean, young_modulus: 6.0e3, poisson_ratio: 0.45}
)";

}  // namespace palpate::test

// The table of models of the program that includes this file, in place of the library's.
namespace palpate::tissue {

std::vector<std::string> modelNames() { return {"splitting"}; }
bool ownsAllOrgans(const std::string&) { return true; }
std::unique_ptr<TissueModel> makeModel(const std::string&, const ModelDescription& description) {
  return std::make_unique<test::SplittingModel>(description);
}

}  // namespace palpate::tissue
