// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "channels.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::node {

/// Copies organs' surfaces for pictures; triangles only when they have become others.
class SurfaceCopies {
 public:
  SurfacePicture take(const tissue::Shape& shape, std::size_t organ) {
    if (organ >= last_.size()) last_.resize(organ + 1);
    Triangles& last = last_[organ];
    if (!last.copy || last.revision != shape.revision) {
      last = {std::make_shared<const Eigen::Matrix3Xi>(shape.triangles), shape.revision};
    }
    return {shape.positions, last.copy, last.revision};
  }

 private:
  struct Triangles {
    std::shared_ptr<const Eigen::Matrix3Xi> copy;
    std::uint64_t revision = 0;
  };
  std::vector<Triangles> last_;  // of each organ
};

}  // namespace palpate::node
