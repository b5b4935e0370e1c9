// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/cutaway.h"

#include <array>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include "box_clip.h"

namespace palpate::mesh {
namespace {

constexpr double kClose = 1e-9;       // over the body's size
constexpr double kLeastArea = 1e-14;  // least area over the squared size

// Tetrahedra of a cell, as corner indices in VTK's order.
using Parts = std::vector<std::array<int, 4>>;

// Around the diagonal from corner 0 to 6: neighbours on a grid split their common side alike.
const Parts kOfHexahedron = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6},
                             {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
// One at each corner, and four around the line between the mid-edge nodes of 01 and 23.
const Parts kOfQuadratic = {{0, 4, 6, 7}, {4, 1, 5, 8}, {6, 5, 2, 9}, {7, 8, 9, 3},
                            {4, 9, 5, 6}, {4, 9, 6, 7}, {4, 9, 7, 8}, {4, 9, 8, 5}};
const Parts kOfLinear = {{0, 1, 2, 3}};

struct Tets {
  Eigen::Matrix4Xi corners;  // with positive volume
  std::vector<int> solid;
};

int solidOf(const CellMesh& body, Eigen::Index cell) {
  const auto c = static_cast<std::size_t>(cell);
  return c < body.solid.size() ? body.solid[c] : 0;
}

Tets tetsOf(const CellMesh& body) {
  const Eigen::Index kind = body.cells.rows();
  const Parts& parts = kind == 8 ? kOfHexahedron : kind == 10 ? kOfQuadratic : kOfLinear;
  Tets tets;
  if (kind != 4 && kind != 8 && kind != 10) return tets;
  tets.corners.resize(4, body.numCells() * static_cast<Eigen::Index>(parts.size()));
  Eigen::Index next = 0;
  for (Eigen::Index c = 0; c < body.numCells(); ++c) {
    for (const std::array<int, 4>& part : parts) {
      Eigen::Vector4i t;
      for (int k = 0; k < 4; ++k) t[k] = body.cells(part[static_cast<std::size_t>(k)], c);
      if (signedVolume(body.points, t) < 0.0) std::swap(t[2], t[3]);
      tets.corners.col(next++) = t;
      tets.solid.push_back(solidOf(body, c));
    }
  }
  return tets;
}

class Cutter {
 public:
  Cutter(const CellMesh& body, const CutBox& box) : X_(body.points), faces_(facesOf(box)) {
    if (X_.cols() > 0) size_ = (X_.rowwise().maxCoeff() - X_.rowwise().minCoeff()).norm();
  }

  // Adds the part of a triangle outside the box; `fourth` is the corner behind it, -1: none.
  void addTriangle(const Eigen::Vector3i& t, int fourth, int solid) {
    const Eigen::Vector4i corners(t[0], t[1], t[2], fourth < 0 ? t[2] : fourth);
    pieces_.clear();
    const CutPolygon whole{
        {Eigen::Vector4d::Unit(0), Eigen::Vector4d::Unit(1), Eigen::Vector4d::Unit(2)}};
    depthsOf(corners).addOutside(whole, fourth >= 0, &pieces_);
    for (const CutPolygon& piece : pieces_) {
      add(piece, corners, normal(whole, corners), solid);
    }
  }
  // Adds the sections of a tetrahedron, whose sides in `outer` (bits) are on the body's surface.
  void addSections(const Eigen::Vector4i& tet, unsigned outer, int solid) {
    const CornerDepths depths = depthsOf(tet);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      if (inOuterSide(depths[f], outer)) continue;
      const CutPolygon polygon = depths.section(f);
      if (polygon.vertices.empty()) continue;
      add(polygon, tet, faces_[f].into * Vec3::Unit(faces_[f].axis), solid);
    }
  }
  Eigen::Index count() const { return static_cast<Eigen::Index>(made_.size()); }

  Cutaway take() {
    Cutaway cut;
    cut.corners.resize(4, 3 * count());
    cut.weights.resize(4, 3 * count());
    for (std::size_t m = 0; m < made_.size(); ++m) {
      for (int k = 0; k < 3; ++k) {
        const Eigen::Index v = 3 * static_cast<Eigen::Index>(m) + k;
        cut.corners.col(v) = made_[m].corners;
        cut.weights.col(v) = made_[m].weights[static_cast<std::size_t>(k)];
      }
      cut.solid.push_back(made_[m].solid);
    }
    for (int i = 0; i < X_.cols(); ++i) {
      const CornerDepths depths = depthsOf(Eigen::Vector4i::Constant(i));
      bool inside = true;
      for (std::size_t f = 0; f < faces_.size(); ++f) inside = inside && depths[f][0] >= 0.0;
      if (inside) cut.bared.push_back(i);
    }
    return cut;
  }

 private:
  struct Made {
    Eigen::Vector4i corners;
    std::array<Eigen::Vector4d, 3> weights;
    int solid;
  };

  Eigen::Matrix<double, 3, 4> at(const Eigen::Vector4i& corners) const {
    Eigen::Matrix<double, 3, 4> x;
    for (int k = 0; k < 4; ++k) x.col(k) = X_.col(corners[k]);
    return x;
  }
  CornerDepths depthsOf(const Eigen::Vector4i& corners) const {
    return {at(corners), faces_, kClose * size_};
  }
  // Whether a face of the box contains a side of the tetrahedron on the body's surface.
  static bool inOuterSide(const Eigen::Vector4d& depth, unsigned outer) {
    for (int k = 0; k < 4; ++k) {
      const bool others = (depth.array() == 0.0).count() == 3 && depth[k] != 0.0;
      if (others && (outer >> k & 1U) != 0U) return true;
    }
    return false;
  }
  Vec3 normal(const CutPolygon& polygon, const Eigen::Vector4i& corners) const {
    const Eigen::Matrix<double, 3, 4> x = at(corners);
    const Vec3 a = x * polygon.vertices[0];
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 1; k + 1 < polygon.vertices.size(); ++k) {
      sum += 0.5 * (x * polygon.vertices[k] - a).cross(x * polygon.vertices[k + 1] - a);
    }
    return sum;
  }
  // Adds a polygon as a triangle fan, oriented towards `out`.
  void add(const CutPolygon& polygon, const Eigen::Vector4i& corners, const Vec3& out, int solid) {
    const Vec3 area = normal(polygon, corners);
    if (area.norm() < kLeastArea * size_ * size_) return;
    const bool turn = area.dot(out) < 0.0;
    for (std::size_t k = 1; k + 1 < polygon.vertices.size(); ++k) {
      const std::size_t second = turn ? k + 1 : k, third = turn ? k : k + 1;
      made_.push_back({corners,
                       {polygon.vertices[0], polygon.vertices[second], polygon.vertices[third]},
                       solid});
    }
  }

  const Points& X_;
  std::vector<BoxFace> faces_;
  double size_ = 0.0;
  std::vector<CutPolygon> pieces_;
  std::vector<Made> made_;
};

}  // namespace

void Cutaway::interpolate(const Points& x, Points* vertices) const {
  vertices->setZero(3, corners.cols());
  for (Eigen::Index v = 0; v < corners.cols(); ++v) {
    for (int k = 0; k < 4; ++k) {
      if (weights(k, v) != 0.0) vertices->col(v) += weights(k, v) * x.col(corners(k, v));
    }
  }
}

Cutaway cutAway(const CellMesh& body, const CutBox& box) {
  if (!(box.low.array() < box.high.array()).all()) {
    throw std::invalid_argument("a box that is cut out needs low < high in all its axes");
  }
  Cutter cutter(body, box);
  const Tets tets = tetsOf(body);
  const std::vector<std::uint8_t> outer = outerSides(tets.corners);
  constexpr int kSides[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  for (Eigen::Index t = 0; t < tets.corners.cols(); ++t) {
    const Eigen::Vector4i tet = tets.corners.col(t);
    for (int k = 0; k < 4; ++k) {
      if ((outer[static_cast<std::size_t>(t)] >> k & 1) == 0) continue;
      const int* side = kSides[k];
      cutter.addTriangle({tet[side[0]], tet[side[1]], tet[side[2]]}, tet[k],
                         tets.solid[static_cast<std::size_t>(t)]);
    }
  }
  if (body.cells.rows() == 3) {
    for (Eigen::Index t = 0; t < body.numCells(); ++t) {
      cutter.addTriangle(body.cells.col(t), -1, solidOf(body, t));
    }
  }
  const Eigen::Index num_outer = cutter.count();
  for (Eigen::Index t = 0; t < tets.corners.cols(); ++t) {
    const auto at = static_cast<std::size_t>(t);
    cutter.addSections(tets.corners.col(t), outer[at], tets.solid[at]);
  }
  Cutaway cut = cutter.take();
  cut.num_outer = num_outer;
  return cut;
}

}  // namespace palpate::mesh
