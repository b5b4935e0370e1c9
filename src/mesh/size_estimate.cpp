// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/size_estimate.h"

#include <cstddef>
#include <deque>

namespace palpate::mesh {
namespace {

// Measured on the shipped organs: mean tetrahedron volume over the cube of the mean edge; 0.118 for
// a regular tetrahedron.
constexpr double kTetPerCube = 0.095;

constexpr double kSizeChange = 0.5;     // largest relative change of the size within a box
constexpr double kBorder = 1.0 / 40.0;  // size of boxes at the surface, over the body's diagonal
constexpr long kMostBoxes = 1000000;    // further boxes are not split

// Position of a box.
enum class Side { kUnknown, kInside };

class Counter {
 public:
  Counter(const SurfaceMesh& surface, const SizeField& field, double most)
      : surface_(surface), sizes_(field, surface_), most_(most) {
    const Vec3 low = surface.points.rowwise().minCoeff();
    const Vec3 high = surface.points.rowwise().maxCoeff();
    smallest_ = 0.5 * kBorder * (high - low).norm();
    result_.of_zone.assign(field.near.size(), 0.0);
    result_.felt.assign(field.near.size(), false);
    // Large boxes first, so that a count that stops early has covered the whole body.
    boxes_.push_back({0.5 * (low + high), 0.5 * (high - low), Side::kUnknown});
    for (long looked = 0; !boxes_.empty() && result_.complete; ++looked) {
      const Box box = boxes_.front();
      boxes_.pop_front();
      look(box, looked < kMostBoxes);
    }
  }

  const SizeEstimate& result() const { return result_; }

 private:
  struct Box {
    Vec3 middle, half;  // half: half side lengths
    Side side;
  };

  void look(const Box& box, bool may_split) {
    const double reach = box.half.norm();
    bool cut = false;
    if (box.side == Side::kUnknown) {
      cut = surface_(box.middle) < reach;
      if (!cut && !surface_.contains(box.middle)) return;
    }
    const double change = sizes_.at(box.middle, reach) - sizes_.at(box.middle, -reach);
    const bool varies = change > kSizeChange * sizes_.at(box.middle);
    if (may_split && (varies || (cut && reach > smallest_))) {
      split(box, cut ? Side::kUnknown : Side::kInside);
      return;
    }
    feel(box.middle, reach);
    if (!cut || surface_.contains(box.middle)) add(box.middle, 8.0 * box.half.prod());
  }

  void split(const Box& box, Side side) {
    for (int k = 0; k < 8; ++k) {
      const Vec3 corner((k & 1) ? 0.5 : -0.5, (k & 2) ? 0.5 : -0.5, (k & 4) ? 0.5 : -0.5);
      boxes_.push_back({box.middle + corner.cwiseProduct(box.half), 0.5 * box.half, side});
    }
  }

  void feel(const Vec3& middle, double reach) {
    for (std::size_t i = 0; i < result_.felt.size(); ++i) {
      if (sizes_.ofZone(i, middle, -reach) < sizes_.field().coarsest) result_.felt[i] = true;
    }
  }

  void add(const Vec3& middle, double volume) {
    const double size = sizes_.at(middle);
    const double tets = estimateTets(volume, size);
    result_.tets += tets;
    for (std::size_t i = 0; i < result_.of_zone.size(); ++i) {
      if (sizes_.ofZone(i, middle) > size) continue;
      result_.of_zone[i] += tets;
      break;
    }
    if (result_.tets > most_) result_.complete = false;
  }

  SurfaceDistance surface_;
  BodySizes sizes_;
  double most_, smallest_ = 0.0;
  std::deque<Box> boxes_;
  SizeEstimate result_;
};

}  // namespace

double estimateTets(double volume, double edge_length) {
  return volume / (kTetPerCube * edge_length * edge_length * edge_length);
}

double edgeLength(double volume) { return std::cbrt(volume / kTetPerCube); }

SizeEstimate estimateTets(const SurfaceMesh& surface, const SizeField& field, double most) {
  return Counter(surface, field, most).result();
}

}  // namespace palpate::mesh
