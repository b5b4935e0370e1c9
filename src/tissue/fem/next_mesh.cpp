// SPDX-License-Identifier: GPL-3.0-or-later
#include "next_mesh.h"

#include <algorithm>
#include <utility>

#include "adaptive_tissue.h"
#include "palpate/mesh/size_estimate.h"

namespace palpate::tissue {

NextMesh::NextMesh(const mesh::TetMesh& coarse, const fem::Composition& composition,
                   const fem::FreeMask& free, const FemSettings& settings,
                   const AdaptSettings& adapt, ThreadPool* pool)
    : composition_(composition),
      free_(free),
      settings_(settings),
      adapt_(adapt),
      pool_(pool),
      nested_(coarse),
      bisected_(nested_.bisected()),
      tools_(0.0, 0.0),
      beside_(pool) {
  settings_.lasting = false;
  for (Eigen::Index t = 0; t < coarse.numTets(); ++t) {
    const double volume = mesh::signedVolume(coarse.points, coarse.tets.col(t));
    coarsest_ = std::max(coarsest_, mesh::edgeLength(volume));
  }
}

double NextMesh::reach() const {
  return kFineWithin * adapt_.finest + std::max(0.0, coarsest_ - adapt_.finest) / adapt_.growth;
}

std::unique_ptr<FemOrgan> NextMesh::make() const {
  fem::Composition composition{composition_.solids, {}, {}};
  for (int t : nested_.coarseTets()) {
    if (!composition_.solid_of.empty()) composition.solid_of.push_back(composition_.solid_of[t]);
    if (!composition_.frames.empty()) composition.frames.push_back(composition_.frames[t]);
  }
  // Between points that are held nothing can move.
  fem::FreeMask free(3, nested_.mesh().numPoints());
  for (int i = 0; i < static_cast<int>(free.cols()); ++i) {
    if (nested_.coarsePoint(i) >= 0) free.col(i) = free_.col(nested_.coarsePoint(i));
  }
  for (const mesh::MeshChange::Middle& m : nested_.middles()) {
    if (nested_.coarsePoint(m.point) >= 0) continue;  // a middle node of the coarse mesh
    free.col(m.point) = free.col(m.a).cwiseMax(free.col(m.b));
  }
  return std::make_unique<FemOrgan>(nested_.mesh(), composition, free, settings_, pool_,
                                    nested_.surface());
}

void NextMesh::restore(const std::string& bisected) {
  beside_.wait();
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

void NextMesh::begin(const Points& x, const ToolDistance& tools) {
  x_ = x;
  tools_ = tools;
  beside_.begin([this] { work(); });
}

void NextMesh::work() {
  const auto size = [&](const Vec3& p) {
    const double way = tools_.distance(p) - kFineWithin * adapt_.finest;
    return adapt_.finest + adapt_.growth * std::max(0.0, way);
  };
  mesh::NestedMesh::Limits limits;
  limits.max_bisections = kMostBisections;
  result_.change = nested_.adapt(x_, size, limits);
  result_.complete = nested_.isComplete();
  if (result_.change && !nested_.isCoarse()) result_.organ = make();
}

NextMesh::Result NextMesh::take() {
  beside_.wait();
  if (result_.change) {
    coarse_ = nested_.isCoarse();
    bisected_ = nested_.bisected();
  }
  return std::exchange(result_, {});
}

void NextMesh::saveTask(StateWriter* out) const {
  out->put(x_);
  tools_.saveTools(out);
}

void NextMesh::restoreTask(StateReader* in) {
  in->get(&x_);
  tools_.restoreTools(in);
  if (x_.cols() != nested_.mesh().numPoints()) StateReader::fail();
  to_resume_ = true;
}

void NextMesh::resume(const std::vector<contact::Obstacle>& obstacles) {
  if (!std::exchange(to_resume_, false)) return;
  tools_.takeShapes(obstacles);
  beside_.begin([this] { work(); });
}

}  // namespace palpate::tissue
