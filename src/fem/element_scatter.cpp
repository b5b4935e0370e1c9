// SPDX-License-Identifier: GPL-3.0-or-later
#include "element_scatter.h"

namespace palpate::fem {
namespace {

template <int N>
BlockMatrix patternOf(const Eigen::Matrix<int, N, Eigen::Dynamic>& elements, int num_nodes) {
  std::vector<std::pair<int, int>> pairs;
  pairs.reserve(static_cast<std::size_t>(N * (N - 1) / 2 * elements.cols()));
  for (Eigen::Index e = 0; e < elements.cols(); ++e) {
    for (int a = 0; a < N; ++a) {
      for (int b = a + 1; b < N; ++b) pairs.emplace_back(elements(a, e), elements(b, e));
    }
  }
  return BlockMatrix(num_nodes, pairs);
}

}  // namespace

template <int N>
ElementScatter<N>::ElementScatter(const Eigen::Matrix<int, N, Eigen::Dynamic>& elements,
                                  int num_nodes)
    : pattern_(patternOf<N>(elements, num_nodes)) {}

template <int N>
void ElementScatter<N>::prepare(const Eigen::Matrix<int, N, Eigen::Dynamic>& elements) {
  const int num_nodes = pattern_.numNodes();
  std::vector<int> upper_number(pattern_.numBlocks(), -1);
  for (int i = 0; i < num_nodes; ++i) {
    for (int slot = pattern_.rowBegin(i); slot < pattern_.rowEnd(i); ++slot) {
      if (pattern_.column(slot) < i) continue;
      upper_number[slot] = static_cast<int>(upper_slot_.size());
      upper_slot_.push_back(slot);
      lower_slot_.push_back(pattern_.find(pattern_.column(slot), i));
    }
  }
  std::vector<int> nodes, vectors, blocks;
  std::vector<BlockSource> block_sources;
  for (Eigen::Index e = 0; e < elements.cols(); ++e) {
    int k = 0;
    for (int a = 0; a < N; ++a) {
      nodes.push_back(elements(a, e));
      vectors.push_back(static_cast<int>(N * e + a));
      for (int b = a; b < N; ++b, ++k) {
        const int i = elements(a, e), j = elements(b, e);
        const bool transposed = i > j;
        blocks.push_back(upper_number[transposed ? pattern_.find(j, i) : pattern_.find(i, j)]);
        block_sources.push_back({static_cast<int>(kBlocks * e + k), transposed});
      }
    }
  }
  node_sources_ = Sources<int>(nodes, vectors, num_nodes);
  block_sources_ =
      Sources<BlockSource>(blocks, block_sources, static_cast<int>(upper_slot_.size()));
}

template <int N>
void ElementScatter<N>::gatherNodes(const Vectors& local, ThreadPool* pool, Points* g) const {
  g->resize(3, static_cast<Eigen::Index>(node_sources_.numTargets()));
  forAll(pool, node_sources_.numTargets(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Vec3 sum = Vec3::Zero();
      for (const int* s = node_sources_.begin(i); s != node_sources_.end(i); ++s) {
        sum += Eigen::Map<const Vec3>(local.data() + 3 * static_cast<std::ptrdiff_t>(*s));
      }
      g->col(static_cast<Eigen::Index>(i)) = sum;
    }
  });
}

template <int N>
void ElementScatter<N>::gatherBlocks(const Blocks& local, ThreadPool* pool, BlockMatrix* K) const {
  forAll(pool, upper_slot_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t u = begin; u < end; ++u) {
      Mat3 sum = Mat3::Zero();
      for (const BlockSource* s = block_sources_.begin(u); s != block_sources_.end(u); ++s) {
        const Eigen::Map<const Mat3> part(local.data() + 9 * static_cast<std::ptrdiff_t>(s->index));
        if (s->transposed) {
          sum += part.transpose();
        } else {
          sum += part;
        }
      }
      K->block(upper_slot_[u]) = sum;
      if (lower_slot_[u] != upper_slot_[u]) K->block(lower_slot_[u]) = sum.transpose();
    }
  });
}

template class ElementScatter<4>;
template class ElementScatter<10>;

}  // namespace palpate::fem
