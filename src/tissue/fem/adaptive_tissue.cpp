// SPDX-License-Identifier: GPL-3.0-or-later
#include "adaptive_tissue.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "fem_organ.h"
#include "palpate/base/state_bytes.h"
#include "palpate/mesh/nested_mesh.h"
#include "tool_distance.h"

namespace palpate::tissue {
namespace {

// A tool that has gone less than this part of `finest` since the mesh was found to suit it need not
// be looked at again.
constexpr double kWorthALook = 0.25;

class AdaptiveTissue final : public TissueModel {
 public:
  AdaptiveTissue(const mesh::TetMesh& mesh, const fem::Composition& composition,
                 const fem::FreeMask& free, const FemSettings& settings, const AdaptSettings& adapt,
                 ThreadPool* pool)
      : composition_(composition),
        free_(free),
        settings_(settings),
        adapt_(adapt),
        pool_(pool),
        nested_(mesh),
        tools_(adapt.finest * kWorthALook) {
    for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
      coarsest_ =
          std::max(coarsest_, mesh::edgeLength(mesh::signedVolume(mesh.points, mesh.tets.col(t))));
    }
    kind_ = "adaptive " + stateKind(settings, mesh.numPoints());
    coarse_ = make();
    coarse_->settle();
    notes_ = coarse_->notes();
    settings_.method = coarse_->methods().front();  // what `auto` took is kept
    organ_ = coarse_.get();
  }

  Shape shape(int) const override {
    const Shape shape = organ_->shape(0);
    return {shape.positions, shape.velocities, shape.triangles, revision_};
  }
  mesh::CellMesh cells(int) const override { return organ_->cells(0); }
  std::vector<std::string> methods() const override { return organ_->methods(); }
  std::vector<std::string> notes() const override { return notes_; }

  void setInterrupt(const solver::Interrupt* interrupt) override {
    interrupt_ = interrupt;
    organ_->setInterrupt(interrupt);
  }

  const TissueStep& step(const std::vector<contact::Obstacle>& obstacles, double dt) override {
    adaptTo(obstacles);
    return organ_->step(obstacles, dt);
  }

  void reset() override {
    nested_.coarsen();
    tools_.forget();
    coarse_->reset();
    become(coarse_.get());
  }

  void place(int, const Points& positions, const Points& velocities) override {
    organ_->place(0, positions, velocities);
    tools_.forget();
  }

  State state() const override {
    StateWriter out;
    out.put(nested_.bisected());
    tools_.save(&out);
    const State state = organ_->state();
    out.put(state.kind);
    out.put(state.bytes);
    return {kind_, out.bytes()};
  }

  void restore(const State& state) override {
    checkKind(state, kind_);
    StateReader in(state.bytes);
    std::string bisected;
    State inner;
    in.get(&bisected);
    tools_.restore(&in);
    in.get(&inner.kind);
    in.get(&inner.bytes);
    in.finish();
    nested_.restore(bisected);
    next();
    organ_->restore(inner);
  }

 private:
  // Refines and joins as the tools' places at the end of the cycle ask for.
  void adaptTo(const std::vector<contact::Obstacle>& obstacles) {
    const double far = kFineWithin * adapt_.finest + (coarsest_ - adapt_.finest) / adapt_.growth;
    const bool plain = organ_ == coarse_.get();
    if (!tools_.look(obstacles, organ_->positions(0), plain ? far : 0.0)) return;
    const auto size = [&](const Vec3& p) {
      const double way = tools_.distance(p) - kFineWithin * adapt_.finest;
      return adapt_.finest + adapt_.growth * std::max(0.0, way);
    };
    const auto change = nested_.adapt(organ_->positions(0), size, {});
    if (!change) return tools_.suited();
    const FemOrgan& old = *organ_;
    const std::unique_ptr<FemOrgan> kept = std::move(fine_);  // `old` may be it
    next();
    organ_->goOnFrom(old, *change);
  }

  // The organ on the present mesh, as yet anywhere.
  void next() {
    if (!nested_.isCoarse()) fine_ = make();
    become(nested_.isCoarse() ? coarse_.get() : fine_.get());
  }
  void become(FemOrgan* organ) {
    organ_ = organ;
    organ_->setInterrupt(interrupt_);
    ++revision_;
  }

  std::unique_ptr<FemOrgan> make() const {
    fem::Composition composition{composition_.solids, {}, {}};
    for (int t : nested_.coarseTets()) {
      if (!composition_.solid_of.empty()) composition.solid_of.push_back(composition_.solid_of[t]);
      if (!composition_.frames.empty()) composition.frames.push_back(composition_.frames[t]);
    }
    // Between points that are held nothing can move.
    const std::vector<int>& coarse = nested_.coarsePoints();
    fem::FreeMask free(3, coarse.size());
    for (std::size_t i = 0; i < coarse.size(); ++i) {
      if (coarse[i] >= 0) free.col(i) = free_.col(coarse[i]);
    }
    for (const mesh::MeshChange::Middle& m : nested_.middles()) {
      free.col(m.point) = free.col(m.a).cwiseMax(free.col(m.b));
    }
    return std::make_unique<FemOrgan>(nested_.mesh(), composition, free, settings_, pool_);
  }

  fem::Composition composition_;  // of the coarse mesh
  fem::FreeMask free_;            // likewise
  FemSettings settings_;
  AdaptSettings adapt_;
  ThreadPool* pool_;
  mesh::NestedMesh nested_;
  ToolDistance tools_;
  double coarsest_ = 0.0;  // edge length [m]
  std::string kind_;
  std::vector<std::string> notes_;
  const solver::Interrupt* interrupt_ = nullptr;
  std::unique_ptr<FemOrgan> coarse_, fine_;
  FemOrgan* organ_ = nullptr;  // one of both
  std::uint64_t revision_ = 0;
};

}  // namespace

std::unique_ptr<TissueModel> makeAdaptiveTissue(const mesh::TetMesh& mesh,
                                                const fem::Composition& composition,
                                                const fem::FreeMask& free,
                                                const FemSettings& settings,
                                                const AdaptSettings& adapt, ThreadPool* pool) {
  if (mesh.quadratic() || settings.element == "tet10") {
    throw std::invalid_argument("adapt needs an element of 4 nodes, not tet10");
  }
  if (settings.method == "linear_precomputed") {
    throw std::invalid_argument(
        "adapt needs another method than linear_precomputed, which computes its answers for one "
        "mesh before it begins");
  }
  return std::make_unique<AdaptiveTissue>(mesh, composition, free, settings, adapt, pool);
}

}  // namespace palpate::tissue
