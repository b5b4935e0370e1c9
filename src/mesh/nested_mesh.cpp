// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/nested_mesh.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <stdexcept>
#include <utility>

#include "bisection_tree.h"
#include "leaves.h"

namespace palpate::mesh {
namespace {

// Tetrahedra are bisected while their longest edge is longer than this part of what is asked for.
// The mean of all edges of a region of uniform size then is what is asked for, to a few percent.
constexpr double kLongest = 1.6;
// Tetrahedra are not joined to one that would be compressed to less than this part of its volume.
constexpr double kLeastJacobian = 0.5;

// Cells are forgotten once there are this many times more than are needed.
constexpr std::size_t kMostIdle = 4;

}  // namespace

struct NestedMesh::Impl {
  explicit Impl(const TetMesh& coarse)
      : coarse_mesh{coarse.points, coarse.tets, coarse.midnodes, {}, {}},
        num_roots(static_cast<int>(coarse.numTets())),
        tree(coarse) {
    cut.cover(tree);
    leaves = leavesOf(cut);
  }

  Leaves leavesOf(const Cut& of) { return {&tree, num_roots, of, coarse_mesh.quadratic()}; }

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
    forCells(tree, num_roots, cut, [&](int c, int) { bits += cut.cells[c] ? '1' : '0'; });
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
    Leaves restored = leavesOf(next);
    if (!restored.conform(tree, next)) fail();
    cut = std::move(next);
    leaves = std::move(restored);
  }

  /// Where a vertex is if the present points are at x, and the others between them.
  Vec3 place(int v, const Points& x) const {
    const int i = leaves.find(v);
    if (i >= 0) return x.col(i);
    return 0.5 * (place(tree.vertex(v).a, x) + place(tree.vertex(v).b, x));
  }
  Vec3 middle(int c, const Points& x) const {
    Vec3 sum = Vec3::Zero();
    for (int v : tree.cell(c).vertex) sum += place(v, x);
    return 0.25 * sum;
  }

  /// det F of a cell as it would be without its children; of a quadratic one the least of four
  /// places half way between its middle and its corners.
  double jacobian(int c, const Points& x) const {
    const BisectionTree::Cell& cell = tree.cell(c);
    Points corners(3, 4);
    for (int k = 0; k < 4; ++k) corners.col(k) = place(cell.vertex[k], x);
    if (!coarse_mesh.quadratic()) {
      const double volume = signedVolume(corners, {0, 1, 2, 3});
      return (cell.odd ? -volume : volume) / tree.volume(c);
    }
    double least = std::numeric_limits<double>::infinity();
    for (int at = 0; at < 4; ++at) {
      Eigen::Vector4d w = Eigen::Vector4d::Constant(0.125);
      w[at] = 0.625;
      Eigen::Matrix<double, 3, 4> slopes = corners * (4.0 * w.array() - 1.0).matrix().asDiagonal();
      for (int i = 0; i < 4; ++i) {
        for (int j = i + 1; j < 4; ++j) {
          const Vec3 middle = middleOf(tree.edge(cell.edge[kEdgeOf[i][j]]), x);
          slopes.col(i) += 4.0 * w[j] * middle;
          slopes.col(j) += 4.0 * w[i] * middle;
        }
      }
      const double volume = signedVolume(slopes, {0, 1, 2, 3});
      least = std::min(least, (cell.odd ? -volume : volume) / tree.volume(c));
    }
    return least;
  }
  Vec3 middleOf(const BisectionTree::Edge& edge, const Points& x) const {
    if (edge.middle >= 0) return place(edge.middle, x);
    return 0.5 * (place(edge.a, x) + place(edge.b, x));
  }

  /// What is asked for, closed under conformity.
  Cut wantedCut(const Points& x, const Size& size, const Limits& limits) {
    Cut wanted;
    int left = limits.max_bisections;
    complete = true;
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
        const bool was = cut.has(c);
        const double allowed = size(middle(c, x));
        bisect = tree.longestEdge(c) > kLongest * (was ? limits.join_below : 1.0) * allowed;
        if (bisect && !was && left-- <= 0) bisect = complete = false;
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

  TetMesh coarse_mesh;
  int num_roots;
  BisectionTree tree;
  Cut cut;
  Leaves leaves;
  bool complete = true;
};

NestedMesh::NestedMesh(const TetMesh& coarse) {
  const Eigen::Index bent = firstBentTet(coarse);
  if (bent >= 0) {
    throw std::invalid_argument("tetrahedron " + std::to_string(bent + 1) +
                                " has a bent edge, and only straight ones can be bisected: use "
                                "4-node tetrahedra, which tet10 gives nodes in the middle of "
                                "straight edges");
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
int NestedMesh::coarsePoint(int point) const {
  const int vertex = impl_->leaves.vertices[point];
  return vertex < impl_->coarse_mesh.numPoints() ? vertex : -1;
}
const std::vector<MeshChange::Middle>& NestedMesh::middles() const { return impl_->leaves.middles; }

std::unique_ptr<MeshChange> NestedMesh::adapt(const Points& x, const Size& size,
                                              const Limits& limits) {
  Cut wanted = impl_->wantedCut(x, size, limits);
  impl_->cut.cover(impl_->tree);
  if (wanted.cells == impl_->cut.cells) return nullptr;
  std::swap(impl_->cut, wanted);
  Leaves next = impl_->leavesOf(impl_->cut);
  auto change =
      std::make_unique<MeshChange>(changeBetween(impl_->tree, impl_->leaves, wanted, next));
  impl_->leaves = std::move(next);
  impl_->prune();
  return change;
}

bool NestedMesh::isComplete() const { return impl_->complete; }

MeshChange NestedMesh::changeFromCoarse() const {
  Cut none;
  none.cover(impl_->tree);
  return changeBetween(impl_->tree, impl_->leavesOf(none), none, impl_->leaves);
}

void NestedMesh::coarsen() {
  impl_->cut = Cut();
  impl_->cut.cover(impl_->tree);
  impl_->leaves = impl_->leavesOf(impl_->cut);
}

std::string NestedMesh::bisected() const { return impl_->bisected(); }
void NestedMesh::restore(const std::string& bisected) { impl_->restore(bisected); }

}  // namespace palpate::mesh
