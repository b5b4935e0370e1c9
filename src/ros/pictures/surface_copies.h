// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/tissue/tissue_model.h"
#include "ros/messages/channels.h"

namespace palpate::node {

/// Copies organs' surfaces for pictures; triangles and cells only when they have become others.
class SurfaceCopies {
 public:
  SurfacePicture take(const tissue::SurfaceState& shape, std::size_t organ) {
    if (organ >= last_.size()) last_.resize(organ + 1);
    Last& last = last_[organ];
    if (!last.copy || last.revision != shape.revision) {
      last.copy = std::make_shared<const Eigen::Matrix3Xi>(shape.triangles);
      last.revision = shape.revision;
    }
    return {shape.positions, last.copy, last.revision};
  }
  /// Adds the cells to a picture that has just been taken.
  void addCells(const sim::Simulator& simulator, int organ, SurfacePicture* picture) {
    Last& last = last_[static_cast<std::size_t>(organ)];
    if (!last.cells || last.cells_revision != picture->revision) {
      last.cells = std::make_shared<const mesh::CellMesh>(simulator.cells(organ));
      last.cells_revision = picture->revision;
    }
    picture->cells = last.cells;
  }

 private:
  struct Last {
    std::shared_ptr<const Eigen::Matrix3Xi> copy;
    std::uint64_t revision = 0;
    std::shared_ptr<const mesh::CellMesh> cells = {};
    std::uint64_t cells_revision = 0;
  };
  std::vector<Last> last_;  // of each organ
};

}  // namespace palpate::node
