// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_adaptation.h"

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

#include "adaptive_tissue.h"
#include "palpate/mesh/size_estimate.h"

namespace palpate::tissue {

MeshAdaptation::MeshAdaptation(const mesh::TetMesh& coarse, const fem::Composition& composition,
                               const Surroundings& surroundings, const FemSettings& settings,
                               const AdaptSettings& adapt, ThreadPool* pool)
    : composition_(composition),
      surroundings_(surroundings),
      settings_(settings),
      adapt_(adapt),
      pool_(pool),
      nested_(coarse),
      bisected_(nested_.bisected()),
      tools_(0.0, 0.0),
      task_(pool) {
  settings_.lasting = false;
  for (Eigen::Index t = 0; t < coarse.numTets(); ++t) {
    const double volume = mesh::signedVolume(coarse.points, coarse.tets.col(t));
    coarsest_ = std::max(coarsest_, mesh::edgeLength(volume));
  }
}

double MeshAdaptation::reach() const {
  return kFineDistance * adapt_.finest + std::max(0.0, coarsest_ - adapt_.finest) / adapt_.growth;
}

std::unique_ptr<FemOrgan> MeshAdaptation::make() const {
  fem::Composition composition{composition_.solids, {}, {}};
  for (int t : nested_.coarseTets()) {
    if (!composition_.solid_of.empty()) composition.solid_of.push_back(composition_.solid_of[t]);
    if (!composition_.frames.empty()) composition.frames.push_back(composition_.frames[t]);
  }
  auto organ = std::make_unique<FemOrgan>(nested_.mesh(), composition, surroundings(), settings_,
                                          pool_, nested_.surface());
  if (coarse_organ_) {
    organ->setEquilibrium(nested_.changeFromCoarse().interpolate(coarse_organ_->equilibrium()));
  }
  return organ;
}

// Boundary conditions on the present mesh: a midpoint has those common to its edge's ends.
Surroundings MeshAdaptation::surroundings() const {
  const Eigen::Index n = nested_.mesh().numPoints();
  const auto forMiddles = [&](const auto& take) {
    for (const mesh::MeshChange::Middle& m : nested_.middles()) {
      if (nested_.coarsePoint(m.point) < 0)
        take(m);  // others are mid-edge nodes of the coarse mesh
    }
  };
  Surroundings fine;
  fine.free.resize(3, n);
  for (int i = 0; i < n; ++i) {
    const int coarse = nested_.coarsePoint(i);
    if (coarse >= 0) fine.free.col(i) = surroundings_.free.col(coarse);
  }
  forMiddles([&](const mesh::MeshChange::Middle& m) {
    fine.free.col(m.point) = fine.free.col(m.a).cwiseMax(fine.free.col(m.b));
  });
  const auto onThisMesh = [&](auto items) {
    for (auto& item : items) {
      std::vector<char> in(static_cast<std::size_t>(n), 0);
      for (int i = 0; i < n; ++i) {
        in[i] = std::binary_search(item.nodes.begin(), item.nodes.end(), nested_.coarsePoint(i));
      }
      forMiddles([&](const mesh::MeshChange::Middle& m) { in[m.point] = in[m.a] && in[m.b]; });
      item.nodes.clear();
      for (int i = 0; i < n; ++i) {
        if (in[i]) item.nodes.push_back(i);
      }
    }
    return items;
  };
  fine.carried = onThisMesh(surroundings_.carried);
  fine.springs = onThisMesh(surroundings_.springs);
  fine.pressures = onThisMesh(surroundings_.pressures);
  return fine;
}

void MeshAdaptation::restore(const std::string& bisected) {
  task_.cancel();
  result_ = {};
  to_resume_ = false;
  if (bisected.empty()) {
    nested_.coarsen();
  } else {
    nested_.restore(bisected);
  }
  coarse_ = nested_.isCoarse();
  bisected_ = nested_.bisected();
}

void MeshAdaptation::begin(const Points& x, const ToolDistance& tools, double finest, double dt) {
  x_ = x;
  finest_ = finest;
  dt_ = dt;
  tools_ = tools;
  beginWork();
}

void MeshAdaptation::beginWork() {
  is_made_ = false;
  task_.begin([this] {
    work();
    is_made_ = true;
  });
}

void MeshAdaptation::work() {
  const auto size = [&](const Vec3& p) {
    const double way = tools_.distance(p) - kFineDistance * finest_;
    return finest_ + adapt_.growth * std::max(0.0, way);
  };
  mesh::NestedMesh::Limits limits;
  limits.max_bisections = kMaxBisections;
  result_.change = nested_.adapt(x_, size, limits);
  result_.complete = nested_.isComplete();
  if (!result_.change) return;
  if (!nested_.isCoarse()) result_.organ = make();
  FemOrgan& organ = result_.organ ? *result_.organ : *coarse_organ_;
  organ.prepareAt(result_.change->interpolate(x_), dt_);
}

// Without a thread for background tasks, take() runs the task.
bool MeshAdaptation::isReady() const {
  return pool_ == nullptr || !pool_->hasBackgroundThread() || is_made_;
}

bool MeshAdaptation::await(const solver::Interrupt& interrupt) const {
  while (!isReady()) {
    if (interrupt()) return false;
    std::this_thread::yield();
  }
  return true;
}

MeshAdaptation::Result MeshAdaptation::take() {
  task_.wait();
  if (result_.change) {
    coarse_ = nested_.isCoarse();
    bisected_ = nested_.bisected();
  }
  return std::exchange(result_, {});
}

void MeshAdaptation::saveTask(StateWriter* out) const {
  out->put(x_);
  out->put(finest_);
  out->put(dt_);
  tools_.saveTools(out);
}

void MeshAdaptation::restoreTask(StateReader* in) {
  in->get(&x_);
  in->get(&finest_);
  in->get(&dt_);
  tools_.restoreTools(in);
  if (x_.cols() != nested_.mesh().numPoints()) StateReader::fail();
  for (const double value : {finest_, dt_}) {
    if (!(value > 0.0 && std::isfinite(value))) StateReader::fail();
  }
  to_resume_ = true;
}

void MeshAdaptation::resume(const std::vector<contact::Obstacle>& obstacles) {
  if (!std::exchange(to_resume_, false)) return;
  tools_.takeShapes(obstacles);
  beginWork();
}

}  // namespace palpate::tissue
