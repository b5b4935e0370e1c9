// SPDX-License-Identifier: GPL-3.0-or-later
#include "adaptive_tissue.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "mesh_adaptation.h"
#include "palpate/base/state_bytes.h"
#include "tissue/organ/fem_organ.h"

namespace palpate::tissue {
namespace {

class AdaptiveTissue final : public OrganBodies {
 public:
  AdaptiveTissue(const mesh::TetMesh& mesh, const fem::Composition& composition,
                 const Surroundings& surroundings, const FemSettings& settings,
                 const AdaptSettings& adapt, ThreadPool* pool)
      : kind_("adaptive " + stateKind(settings, mesh.numPoints())),
        finest_(adapt.finest),
        tools_(kMinToolMotion * adapt.finest, kMaxLookAhead * adapt.finest),
        adaptation_(mesh, composition, surroundings, settings, adapt, pool) {
    coarse_ = adaptation_.make();
    coarse_->findEquilibrium();
    adaptation_.setCoarse(coarse_.get());
    notes_ = coarse_->notes();
    adaptation_.useMethod(coarse_->methods(0).front());  // keep the choice of `auto`
    become(coarse_.get());
  }

  SurfaceState surfaceState(int) const override {
    const SurfaceState shape = organ_->surfaceState(0);
    return {shape.positions, shape.velocities, shape.triangles, revision_};
  }
  mesh::CellMesh cells(int) const override { return organ_->cells(0); }
  std::vector<std::string> methods(int) const override { return organ_->methods(0); }
  std::vector<std::string> notes() const override { return notes_; }

  void setInterrupt(const solver::Interrupt* interrupt) override {
    interrupt_ = interrupt;
    organ_->setInterrupt(interrupt);
  }

  void setMeshPace(const MeshPace& pace) override { pace_ = pace; }

  void beginCycle(const std::vector<contact::Obstacle>& obstacles, double) override {
    // Only moving tools count.
    moving_.clear();
    for (const contact::Obstacle& obstacle : obstacles) {
      if (obstacle.owner.isInstrument()) moving_.push_back(obstacle);
    }
    adaptation_.resume(moving_);
    if (cycles_left_ == 0) return;
    cycles_left_ = std::max(cycles_left_ - 1, 0);
    if (pace_.when_ready ? adaptation_.isReady() : cycles_left_ == 0 && isInTime()) {
      cycles_left_ = 0;
      return takeNext();
    }
    cycles_left_ = std::max(cycles_left_, 1);
  }
  void addBodies(std::vector<FemOrgan*>* bodies) override { bodies->push_back(organ_); }

  const TissueStep& endCycle(const std::vector<contact::Obstacle>&, double dt) override {
    // The background task begins last, so that it runs while the caller waits for its next cycle.
    const Points& x = organ_->positions(0);
    const double far = organ_ == coarse_.get() ? adaptation_.reach() : 0.0;
    if (pace_.coarsening != coarsening_) tools_.forget();
    if (cycles_left_ == 0 && tools_.look(moving_, kLookAheadTime / dt, x, far, pace_.coarsening)) {
      beginNext(x, dt);
    }
    out_ = organ_->report();
    out_.finest_edge = coarsening_ * finest_;
    return out_;
  }

  void reset() override {
    cycles_left_ = 0;
    coarsening_ = pace_.coarsening;
    tools_.forget();
    adaptation_.restore("");
    fine_.reset();
    coarse_->reset();
    become(coarse_.get());
  }

  void setPositions(int, const Points& positions, const Points& velocities) override {
    organ_->setPositions(0, positions, velocities);
    tools_.forget();
  }

  State state() const override {
    StateWriter out;
    const State state = organ_->state();
    out.put(adaptation_.bisected());
    out.put(state.kind);
    out.put(state.bytes);
    tools_.save(&out);
    out.put(coarsening_);
    out.put(cycles_left_);
    if (cycles_left_ > 0) adaptation_.saveTask(&out);
    return {kind_, out.bytes()};
  }

  void restore(const State& state) override {
    checkKind(state, kind_);
    StateReader in(state.bytes);
    std::string bisected;
    State inner;
    in.get(&bisected);
    in.get(&inner.kind);
    in.get(&inner.bytes);
    adaptation_.restore(bisected);
    fine_ = adaptation_.isCoarse() ? nullptr : adaptation_.make();
    become(fine_ ? fine_.get() : coarse_.get());
    organ_->reset();
    organ_->restore(inner);
    tools_.restore(&in);
    in.get(&coarsening_);
    if (!(coarsening_ >= 1.0 && std::isfinite(coarsening_))) StateReader::fail();
    in.get(&cycles_left_);
    if (cycles_left_ > 0) adaptation_.restoreTask(&in);
    in.finish();
  }

 private:
  // In a replay the next mesh is used a fixed number of cycles later: results do not depend on
  // time.
  void beginNext(const Points& x, double dt) {
    coarsening_ = pace_.coarsening;
    adaptation_.begin(x, tools_, coarsening_ * finest_, dt);
    tools_.suited();
    const double cycles = std::min(std::ceil(kBackgroundTime / dt - 1e-6), 1e6);
    cycles_left_ = std::max(kMinBackgroundCycles, static_cast<int>(cycles));
  }

  // With a deadline, the first cycle waits for the mesh until then; later ones use it when it is
  // ready.
  bool isInTime() {
    const bool waits = !std::exchange(late_, false);
    if (interrupt_ == nullptr || !*interrupt_) return true;
    late_ = !adaptation_.await(waits ? *interrupt_ : [] { return true; });
    return !late_;
  }

  // A mesh with inverted elements at the present positions is dropped and requested again.
  void takeNext() {
    const std::string before = adaptation_.bisected();
    MeshAdaptation::Result next = adaptation_.take();
    if (!next.complete) tools_.forget();
    if (!next.change) return;
    const FemOrgan& old = *organ_;
    const FemOrgan& organ = next.organ ? *next.organ : *coarse_;
    if (!organ.canGoOnFrom(old, *next.change)) {
      adaptation_.restore(before);
      return tools_.forget();
    }
    const std::unique_ptr<FemOrgan> kept = std::exchange(fine_, std::move(next.organ));
    become(fine_ ? fine_.get() : coarse_.get());
    organ_->goOnFrom(old, *next.change);
  }

  void become(FemOrgan* organ) {
    organ_ = organ;
    organ_->setInterrupt(interrupt_);
    ++revision_;
  }

  std::string kind_;
  double finest_;  // edge length at a tool, of the settings [m]
  MeshPace pace_;
  double coarsening_ = 1.0;  // of the last requested mesh
  std::vector<contact::Obstacle> moving_;
  ToolDistance tools_;
  std::unique_ptr<FemOrgan> coarse_, fine_;
  MeshAdaptation adaptation_;  // destroyed before the members it uses
  FemOrgan* organ_ = nullptr;  // body on the present mesh: coarse_ or fine_
  int cycles_left_ = 0;        // until the next mesh is used; 0: none requested
  bool late_ = false;          // whether its cycle has passed
  TissueStep out_;
  std::vector<std::string> notes_;
  const solver::Interrupt* interrupt_ = nullptr;
  std::uint64_t revision_ = 0;
};

}  // namespace

std::unique_ptr<OrganBodies> makeAdaptiveTissue(const mesh::TetMesh& mesh,
                                                const fem::Composition& composition,
                                                const Surroundings& surroundings,
                                                const FemSettings& settings,
                                                const AdaptSettings& adapt, ThreadPool* pool) {
  if (settings.method == "linear_precomputed") {
    throw std::invalid_argument(
        "method = linear_precomputed, with adapt.finest: must be another one; it computes its "
        "answers for one mesh before it begins");
  }
  return std::make_unique<AdaptiveTissue>(mesh, composition, surroundings, settings, adapt, pool);
}

}  // namespace palpate::tissue
