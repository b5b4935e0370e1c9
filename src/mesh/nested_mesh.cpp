// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/nested_mesh.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <stdexcept>
#include <utility>

#include "bisection_tree.h"

namespace palpate::mesh {
namespace {

// Faces of a tetrahedron of positive volume, the k-th opposite corner k, outward.
constexpr int kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

// Bisected while larger than this, so that edge lengths, halved in volume, spread around what is
// asked for: the sixth root of two.
constexpr double kSpread = 1.122462048309373;
// Tetrahedra are not joined to one that would be compressed to less than this part of its volume.
constexpr double kLeastJacobian = 0.5;

// Cells are forgotten once there are this many times more than are needed.
constexpr std::size_t kMostIdle = 4;

/// The cells that are bisected, and the edges that are by that.
struct Cut {
  std::vector<char> cells, edges;

  void cover(const BisectionTree& tree) {
    cells.resize(static_cast<std::size_t>(tree.numCells()), 0);
    edges.resize(static_cast<std::size_t>(tree.numEdges()), 0);
  }
};

/// A mesh of the cells that are not cut.
struct Leaves {
  TetMesh mesh;
  Eigen::Matrix3Xi surface;
  std::vector<int> cells;     ///< Of each tetrahedron.
  std::vector<int> vertices;  ///< Of each point.
  std::vector<int> number;    ///< Of each vertex of the tree; -1: none.
  std::vector<int> coarse_tets, coarse_points;
  std::vector<MeshChange::Middle> middles;
};

}  // namespace

struct NestedMesh::Impl {
  explicit Impl(const TetMesh& coarse)
      : coarse_mesh{coarse.points, coarse.tets, {}, {}, {}},
        num_roots(static_cast<int>(coarse.numTets())),
        num_coarse_points(static_cast<int>(coarse.numPoints())),
        tree(coarse) {
    cut.cover(tree);
    leaves = collect();
  }

  /// Forgets the cells that are not there, if they have become many. Numbers of the mesh stay.
  void prune() {
    const std::size_t there = 2 * leaves.cells.size();
    if (static_cast<std::size_t>(tree.numCells()) < kMostIdle * there) return;
    const std::string bits = bisected();
    tree = BisectionTree(coarse_mesh);
    restore(bits);
  }

  std::string bisected() const {
    std::string bits;
    traverse([&](int c, int) { bits += cut.cells[c] ? '1' : '0'; });
    return bits;
  }

  void restore(const std::string& bisected) {
    const auto fail = [] {
      throw std::invalid_argument("the state is not one of this organ's adapted mesh");
    };
    Cut next;
    std::size_t at = 0;
    std::vector<int> stack;
    for (int root = 0; root < num_roots; ++root) {
      stack.assign(1, root);
      while (!stack.empty()) {
        const int c = stack.back();
        stack.pop_back();
        if (at == bisected.size()) fail();
        if (bisected[at++] != '1') continue;
        if (tree.cell(c).child < 0) tree.bisect(c);
        next.cover(tree);
        next.cells[c] = next.edges[tree.cell(c).edge[0]] = 1;
        stack.push_back(tree.cell(c).child + 1);
        stack.push_back(tree.cell(c).child);
      }
    }
    if (at != bisected.size()) fail();
    next.cover(tree);
    std::swap(cut, next);
    Leaves restored = collect();
    for (int c : restored.cells) {
      const auto& edges = tree.cell(c).edge;
      if (std::any_of(edges.begin(), edges.end(), [&](int e) { return cut.edges[e]; })) {
        std::swap(cut, next);
        cut.cover(tree);
        fail();
      }
    }
    leaves = std::move(restored);
  }

  /// visit(cell, root) on all cells that are there, parents first.
  template <class Visit>
  void traverse(const Visit& visit) const {
    std::vector<int> stack;
    for (int root = 0; root < num_roots; ++root) {
      stack.assign(1, root);
      while (!stack.empty()) {
        const int c = stack.back();
        stack.pop_back();
        visit(c, root);
        if (!cut.cells[c]) continue;
        stack.push_back(tree.cell(c).child + 1);
        stack.push_back(tree.cell(c).child);
      }
    }
  }

  Leaves collect() const {
    Leaves l;
    l.number.assign(static_cast<std::size_t>(tree.numVertices()), -1);
    std::vector<std::array<int, 4>> tets;
    std::vector<std::array<int, 3>> triangles;
    traverse([&](int c, int root) {
      if (cut.cells[c]) return;
      const BisectionTree::Cell& cell = tree.cell(c);
      std::array<int, 4> place{0, 1, 2, 3};
      if (cell.odd) std::swap(place[2], place[3]);
      std::array<int, 4> tet;
      for (int k = 0; k < 4; ++k) {
        const int v = cell.vertex[place[k]];
        if (l.number[v] < 0) {
          l.number[v] = static_cast<int>(l.vertices.size());
          l.vertices.push_back(v);
        }
        tet[k] = l.number[v];
      }
      for (int k = 0; k < 4; ++k) {
        if (cell.boundary >> place[k] & 1) {
          triangles.push_back({tet[kFaces[k][0]], tet[kFaces[k][1]], tet[kFaces[k][2]]});
        }
      }
      tets.push_back(tet);
      l.cells.push_back(c);
      l.coarse_tets.push_back(root);
    });
    l.mesh.points.resize(3, static_cast<Eigen::Index>(l.vertices.size()));
    for (std::size_t i = 0; i < l.vertices.size(); ++i) {
      l.mesh.points.col(static_cast<Eigen::Index>(i)) = tree.rest(l.vertices[i]);
      l.coarse_points.push_back(l.vertices[i] < num_coarse_points ? l.vertices[i] : -1);
    }
    l.mesh.tets = Eigen::Map<const Eigen::Matrix4Xi>(tets.front().data(), 4,
                                                     static_cast<Eigen::Index>(tets.size()));
    l.middles = middlesOf(l, [](int) { return true; });
    if (!triangles.empty()) {
      l.surface = Eigen::Map<const Eigen::Matrix3Xi>(triangles.front().data(), 3,
                                                     static_cast<Eigen::Index>(triangles.size()));
    }
    return l;
  }

  /// The points of `l` that are between others, if `asked(vertex)`; those that they are between
  /// before them.
  template <class Asked>
  std::vector<MeshChange::Middle> middlesOf(const Leaves& l, const Asked& asked) const {
    std::vector<MeshChange::Middle> middles;
    for (std::size_t i = 0; i < l.vertices.size(); ++i) {
      const BisectionTree::Vertex& vertex = tree.vertex(l.vertices[i]);
      if (vertex.a < 0 || !asked(l.vertices[i])) continue;
      middles.push_back({static_cast<int>(i), l.number[vertex.a], l.number[vertex.b]});
    }
    std::stable_sort(middles.begin(), middles.end(), [&](const auto& m, const auto& n) {
      return tree.vertex(l.vertices[m.point]).depth < tree.vertex(l.vertices[n.point]).depth;
    });
    return middles;
  }

  /// Where a vertex is if the present points are at x, and the others between them.
  Vec3 place(int v, const Points& x) const {
    const int i = v < static_cast<int>(leaves.number.size()) ? leaves.number[v] : -1;
    if (i >= 0) return x.col(i);
    return 0.5 * (place(tree.vertex(v).a, x) + place(tree.vertex(v).b, x));
  }
  Vec3 middle(int c, const Points& x) const {
    Vec3 sum = Vec3::Zero();
    for (int v : tree.cell(c).vertex) sum += place(v, x);
    return 0.25 * sum;
  }

  /// det F of a cell as it would be without its children.
  double jacobian(int c, const Points& x) const {
    const BisectionTree::Cell& cell = tree.cell(c);
    Points corners(3, 4);
    for (int k = 0; k < 4; ++k) corners.col(k) = place(cell.vertex[k], x);
    const double volume = signedVolume(corners, {0, 1, 2, 3});
    return (cell.odd ? -volume : volume) / tree.volume(c);
  }

  /// What is asked for, closed under conformity.
  Cut wantedCut(const Points& x, const Size& size, const Limits& limits) {
    Cut wanted;
    int left = limits.max_bisections;
    std::deque<int> waiting;
    for (int root = 0; root < num_roots; ++root) waiting.push_back(root);
    while (!waiting.empty()) {
      const int c = waiting.front();
      waiting.pop_front();
      wanted.cover(tree);
      if (wanted.cells[c]) continue;
      const auto& edges = tree.cell(c).edge;
      bool bisect =
          std::any_of(edges.begin(), edges.end(), [&](int e) { return wanted.edges[e] != 0; });
      if (!bisect) {
        const bool was = c < static_cast<int>(cut.cells.size()) && cut.cells[c];
        const double allowed = size(middle(c, x));
        const double length = edgeLength(tree.volume(c));
        bisect = length > kSpread * (was ? limits.join_below : 1.0) * allowed;
        if (bisect && !was && left-- <= 0) bisect = false;
        if (!bisect && was) bisect = jacobian(c, x) < kLeastJacobian;
      }
      if (!bisect) continue;
      bisectIn(&wanted, c, &waiting);
    }
    wanted.cover(tree);
    return wanted;
  }

  /// Cuts a cell; its children, and all that have the cut edge, are to be looked at.
  void bisectIn(Cut* wanted, int c, std::deque<int>* waiting) {
    if (tree.cell(c).child < 0) tree.bisect(c);
    wanted->cover(tree);
    wanted->cells[c] = 1;
    const int edge = tree.cell(c).edge[0];
    if (!wanted->edges[edge]) {
      wanted->edges[edge] = 1;
      for (int other : tree.edge(edge).cells) {
        const int parent = tree.cell(other).parent;
        const bool there = parent < 0 || wanted->cells[parent];
        if (other != c && there && !wanted->cells[other]) waiting->push_back(other);
      }
    }
    waiting->push_back(tree.cell(c).child);
    waiting->push_back(tree.cell(c).child + 1);
  }

  /// From the present leaves to `next`, with the cells that were cut in `before`.
  MeshChange changeTo(const Leaves& next, const Cut& before) const {
    MeshChange change;
    change.num_old_points = static_cast<int>(leaves.vertices.size());
    const auto oldNumber = [&](int v) {
      return v < static_cast<int>(leaves.number.size()) ? leaves.number[v] : -1;
    };
    for (int v : next.vertices) change.old_point.push_back(oldNumber(v));
    change.added = middlesOf(next, [&](int v) { return oldNumber(v) < 0; });
    change.removed = middlesOf(leaves, [&](int v) { return next.number[v] < 0; });
    std::reverse(change.removed.begin(), change.removed.end());
    addTets(next, before, &change);
    return change;
  }

  // Both lists of leaves are in the order of the trees: what lies below a cell is together.
  void addTets(const Leaves& next, const Cut& before, MeshChange* change) const {
    std::vector<int> old_tet(static_cast<std::size_t>(tree.numCells()), -1);
    for (std::size_t t = 0; t < leaves.cells.size(); ++t) {
      old_tet[leaves.cells[t]] = static_cast<int>(t);
    }
    const auto wasCut = [&](int c) {
      return c < static_cast<int>(before.cells.size()) && before.cells[c];
    };
    for (int cell : next.cells) {
      int c = cell;
      if (wasCut(c)) {
        int first = c, last = c;
        while (wasCut(first)) first = tree.cell(first).child;
        while (wasCut(last)) last = tree.cell(last).child + 1;
        change->tets.push_back({old_tet[first], old_tet[last] + 1});
        continue;
      }
      while (old_tet[c] < 0) c = tree.cell(c).parent;
      change->tets.push_back({old_tet[c], old_tet[c] + 1});
    }
  }

  TetMesh coarse_mesh;
  int num_roots, num_coarse_points;
  BisectionTree tree;
  Cut cut;
  Leaves leaves;
};

NestedMesh::NestedMesh(const TetMesh& coarse) {
  if (coarse.quadratic()) {
    throw std::invalid_argument("a mesh of 10-node tetrahedra cannot be bisected");
  }
  impl_ = std::make_unique<Impl>(coarse);
}
NestedMesh::~NestedMesh() = default;
NestedMesh::NestedMesh(NestedMesh&&) noexcept = default;
NestedMesh& NestedMesh::operator=(NestedMesh&&) noexcept = default;

bool NestedMesh::isCoarse() const {
  return static_cast<int>(impl_->leaves.cells.size()) == impl_->num_roots;
}
const TetMesh& NestedMesh::mesh() const { return impl_->leaves.mesh; }
const Eigen::Matrix3Xi& NestedMesh::surface() const { return impl_->leaves.surface; }
const std::vector<int>& NestedMesh::coarseTets() const { return impl_->leaves.coarse_tets; }
const std::vector<int>& NestedMesh::coarsePoints() const { return impl_->leaves.coarse_points; }
const std::vector<MeshChange::Middle>& NestedMesh::middles() const { return impl_->leaves.middles; }

std::unique_ptr<MeshChange> NestedMesh::adapt(const Points& x, const Size& size,
                                              const Limits& limits) {
  Cut wanted = impl_->wantedCut(x, size, limits);
  impl_->cut.cover(impl_->tree);
  if (wanted.cells == impl_->cut.cells) return nullptr;
  std::swap(impl_->cut, wanted);
  Leaves next = impl_->collect();
  auto change = std::make_unique<MeshChange>(impl_->changeTo(next, wanted));
  impl_->leaves = std::move(next);
  impl_->prune();
  return change;
}

void NestedMesh::coarsen() {
  impl_->cut = Cut();
  impl_->cut.cover(impl_->tree);
  impl_->leaves = impl_->collect();
}

std::string NestedMesh::bisected() const { return impl_->bisected(); }
void NestedMesh::restore(const std::string& bisected) { impl_->restore(bisected); }

double edgeLength(double volume) {
  // As estimateTets(): the mean tetrahedron has this part of the cube of the mean edge.
  constexpr double kTetPerCube = 0.095;
  return std::cbrt(volume / kTetPerCube);
}

}  // namespace palpate::mesh
