// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/tet_mesh.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

namespace palpate::mesh {
namespace {

// Faces of a tetrahedron of positive volume, counter-clockwise from outside.
constexpr int kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

// Kuhn's six tetrahedra of a cell: the monotone paths from corner 000 to corner 111. Bit i of a
// corner's index is its step along axis i.
constexpr int kKuhn[6][4] = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7},
                             {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};

// Edges in the order of mid-edge nodes.
constexpr int kEdges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};

// Largest distance of a straight edge's mid-edge node from the midpoint, over the edge length.
constexpr double kStraight = 1e-9;

int edgeNumber(int a, int b) {
  int k = 0;
  while (!((kEdges[k][0] == a && kEdges[k][1] == b) || (kEdges[k][0] == b && kEdges[k][1] == a))) {
    ++k;
  }
  return k;
}

struct Face {
  Eigen::Index tet;
  int side;  // index in kFaces
};

// Faces with a single tetrahedron, in the order of the tetrahedra.
std::vector<Face> outerFaces(const Eigen::Matrix4Xi& tets) {
  const std::vector<std::uint8_t> outer = outerSides(tets);
  std::vector<Face> faces;
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    for (int f = 0; f < 4; ++f) {
      if (outer[static_cast<std::size_t>(e)] >> f & 1) faces.push_back({e, f});
    }
  }
  return faces;
}

}  // namespace

double signedVolume(const Points& points, const Eigen::Vector4i& t) {
  const Vec3 a = points.col(t[0]);
  return (points.col(t[1]) - a).cross(points.col(t[2]) - a).dot(points.col(t[3]) - a) / 6.0;
}

std::vector<std::uint8_t> outerSides(const Eigen::Matrix4Xi& tets) {
  // Faces are stored at their least corner, so the two sides of a face meet there.
  struct Side {
    int middle, largest;  // the other two corners
    int face;             // 4 tet + side
  };
  std::vector<std::uint8_t> outer(static_cast<std::size_t>(tets.cols()), 0);
  if (tets.size() == 0) return outer;
  std::vector<int> begin(static_cast<std::size_t>(tets.maxCoeff()) + 2, 0);
  const auto sorted = [&](int face) {
    const int* corners = kFaces[face % 4];
    const Eigen::Index e = face / 4;
    std::array<int, 3> c{tets(corners[0], e), tets(corners[1], e), tets(corners[2], e)};
    if (c[0] > c[1]) std::swap(c[0], c[1]);
    if (c[1] > c[2]) std::swap(c[1], c[2]);
    if (c[0] > c[1]) std::swap(c[0], c[1]);
    return c;
  };
  const int num_faces = static_cast<int>(4 * tets.cols());
  for (int f = 0; f < num_faces; ++f) ++begin[sorted(f)[0] + 1];
  for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
  std::vector<Side> sides(static_cast<std::size_t>(num_faces));
  std::vector<int> next(begin);
  for (int f = 0; f < num_faces; ++f) {
    const std::array<int, 3> c = sorted(f);
    sides[next[c[0]]++] = {c[1], c[2], f};
  }
  for (std::size_t i = 0; i + 1 < begin.size(); ++i) {
    for (int k = begin[i]; k < begin[i + 1]; ++k) {
      int same = 0;
      for (int l = begin[i]; l < begin[i + 1]; ++l) {
        same += sides[l].middle == sides[k].middle && sides[l].largest == sides[k].largest;
      }
      if (same > 1) continue;
      std::uint8_t& bits = outer[sides[k].face / 4];
      bits = static_cast<std::uint8_t>(bits | 1 << sides[k].face % 4);
    }
  }
  return outer;
}

Eigen::Matrix3Xi boundaryTriangles(const Eigen::Matrix4Xi& tets) {
  const std::vector<Face> boundary = outerFaces(tets);
  Eigen::Matrix3Xi triangles(3, boundary.size());
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      triangles(c, static_cast<Eigen::Index>(i)) =
          tets(kFaces[boundary[i].side][c], boundary[i].tet);
    }
  }
  return triangles;
}

Eigen::MatrixXi boundaryFaces(const TetMesh& mesh) {
  if (!mesh.quadratic()) return boundaryTriangles(mesh.tets);
  const std::vector<Face> boundary = outerFaces(mesh.tets);
  Eigen::MatrixXi faces(6, static_cast<Eigen::Index>(boundary.size()));
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const int* corners = kFaces[boundary[i].side];
    for (int c = 0; c < 3; ++c) {
      faces(c, column) = mesh.tets(corners[c], boundary[i].tet);
      faces(3 + c, column) =
          mesh.midnodes(edgeNumber(corners[c], corners[(c + 1) % 3]), boundary[i].tet);
    }
  }
  return faces;
}

Eigen::Matrix3Xi trianglesOf(const Eigen::MatrixXi& faces) {
  if (faces.rows() == 3) return faces;
  constexpr int kParts[4][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
  Eigen::Matrix3Xi triangles(3, 4 * faces.cols());
  for (Eigen::Index f = 0; f < faces.cols(); ++f) {
    for (int part = 0; part < 4; ++part) {
      for (int c = 0; c < 3; ++c) triangles(c, 4 * f + part) = faces(kParts[part][c], f);
    }
  }
  return triangles;
}

TetMesh toQuadratic(const TetMesh& mesh) {
  if (mesh.quadratic()) return mesh;
  TetMesh quadratic = mesh;
  quadratic.midnodes.resize(6, mesh.numTets());
  std::map<std::pair<int, int>, int> middle;
  std::vector<Vec3> points;
  for (Eigen::Index e = 0; e < mesh.numTets(); ++e) {
    for (int k = 0; k < 6; ++k) {
      const int a = mesh.tets(kEdges[k][0], e), b = mesh.tets(kEdges[k][1], e);
      const auto [found, fresh] =
          middle.try_emplace(std::minmax(a, b), static_cast<int>(mesh.numPoints() + points.size()));
      if (fresh) points.push_back(0.5 * (mesh.points.col(a) + mesh.points.col(b)));
      quadratic.midnodes(k, e) = found->second;
    }
  }
  quadratic.points.conservativeResize(3, mesh.numPoints() + points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    quadratic.points.col(mesh.numPoints() + static_cast<Eigen::Index>(i)) = points[i];
  }
  return quadratic;
}

Eigen::Index firstBentTet(const TetMesh& mesh) {
  for (Eigen::Index e = 0; e < mesh.midnodes.cols(); ++e) {
    for (int k = 0; k < 6; ++k) {
      const Vec3 a = mesh.points.col(mesh.tets(kEdges[k][0], e));
      const Vec3 b = mesh.points.col(mesh.tets(kEdges[k][1], e));
      const Vec3 off = mesh.points.col(mesh.midnodes(k, e)) - 0.5 * (a + b);
      if (off.norm() > kStraight * (b - a).norm()) return e;
    }
  }
  return -1;
}

TetMesh boxMesh(const Vec3& size, const Eigen::Vector3i& cells) {
  TetMesh mesh;
  const Eigen::Vector3i n = cells.array() + 1;
  mesh.points.resize(3, n.prod());
  const auto node = [&](int i, int j, int k) { return i + n.x() * (j + n.y() * k); };
  for (int k = 0; k < n.z(); ++k) {
    for (int j = 0; j < n.y(); ++j) {
      for (int i = 0; i < n.x(); ++i) {
        mesh.points.col(node(i, j, k)) =
            size.cwiseProduct(Vec3(i, j, k).cwiseQuotient(cells.cast<double>()));
      }
    }
  }
  mesh.tets.resize(4, 6 * cells.prod());
  Eigen::Index e = 0;
  for (int k = 0; k < cells.z(); ++k) {
    for (int j = 0; j < cells.y(); ++j) {
      for (int i = 0; i < cells.x(); ++i) {
        for (const auto& path : kKuhn) {
          for (int c = 0; c < 4; ++c) {
            const int corner = path[c];
            mesh.tets(c, e) = node(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2));
          }
          ++e;
        }
      }
    }
  }
  return mesh;
}

}  // namespace palpate::mesh
