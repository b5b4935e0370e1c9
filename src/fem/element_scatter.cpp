// SPDX-License-Identifier: GPL-3.0-or-later
#include "element_scatter.h"

namespace palpate::fem {
namespace {

BlockMatrix patternOf(const Eigen::Matrix4Xi& elements, int num_nodes) {
  std::vector<std::pair<int, int>> pairs;
  pairs.reserve(6 * elements.cols());
  for (Eigen::Index e = 0; e < elements.cols(); ++e) {
    for (int a = 0; a < 4; ++a) {
      for (int b = a + 1; b < 4; ++b) pairs.emplace_back(elements(a, e), elements(b, e));
    }
  }
  return BlockMatrix(num_nodes, pairs);
}

// Counting sort of `sources` by `key`: start[k] .. start[k + 1] are those of key k, in order.
template <class Source>
void groupBy(const std::vector<int>& key, int num_keys, std::vector<Source>* sources,
             std::vector<int>* start) {
  start->assign(num_keys + 1, 0);
  for (int k : key) ++(*start)[k + 1];
  for (int k = 0; k < num_keys; ++k) (*start)[k + 1] += (*start)[k];
  std::vector<int> next(start->begin(), start->end() - 1);
  std::vector<Source> sorted(sources->size());
  for (std::size_t s = 0; s < sources->size(); ++s) sorted[next[key[s]]++] = (*sources)[s];
  *sources = std::move(sorted);
}

}  // namespace

ElementScatter::ElementScatter(const Eigen::Matrix4Xi& elements, int num_nodes)
    : pattern_(patternOf(elements, num_nodes)) {
  std::vector<int> upper_number(pattern_.numBlocks(), -1);
  for (int i = 0; i < num_nodes; ++i) {
    for (int slot = pattern_.rowBegin(i); slot < pattern_.rowEnd(i); ++slot) {
      if (pattern_.column(slot) < i) continue;
      upper_number[slot] = static_cast<int>(upper_slot_.size());
      upper_slot_.push_back(slot);
      lower_slot_.push_back(pattern_.find(pattern_.column(slot), i));
    }
  }
  std::vector<int> node_key, block_key;
  for (Eigen::Index e = 0; e < elements.cols(); ++e) {
    int k = 0;
    for (int a = 0; a < 4; ++a) {
      node_key.push_back(elements(a, e));
      node_source_.push_back({static_cast<int>(4 * e + a), false});
      for (int b = a; b < 4; ++b, ++k) {
        const int i = elements(a, e), j = elements(b, e);
        const bool transposed = i > j;
        block_key.push_back(upper_number[transposed ? pattern_.find(j, i) : pattern_.find(i, j)]);
        block_source_.push_back({static_cast<int>(kBlocks * e + k), transposed});
      }
    }
  }
  groupBy(node_key, num_nodes, &node_source_, &node_start_);
  groupBy(block_key, static_cast<int>(upper_slot_.size()), &block_source_, &block_start_);
}

void ElementScatter::gatherNodes(const Eigen::Matrix<double, 12, Eigen::Dynamic>& local,
                                 ThreadPool* pool, Points* g) const {
  const std::size_t num_nodes = node_start_.size() - 1;
  g->resize(3, num_nodes);
  forAll(pool, num_nodes, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Vec3 sum = Vec3::Zero();
      for (int s = node_start_[i]; s < node_start_[i + 1]; ++s) {
        sum += Eigen::Map<const Vec3>(local.data() + 3 * node_source_[s].index);
      }
      g->col(i) = sum;
    }
  });
}

void ElementScatter::gatherBlocks(const Eigen::Matrix<double, 90, Eigen::Dynamic>& local,
                                  ThreadPool* pool, BlockMatrix* K) const {
  forAll(pool, upper_slot_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t u = begin; u < end; ++u) {
      Mat3 sum = Mat3::Zero();
      for (int s = block_start_[u]; s < block_start_[u + 1]; ++s) {
        const Eigen::Map<const Mat3> part(local.data() + 9 * block_source_[s].index);
        if (block_source_[s].transposed) {
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

}  // namespace palpate::fem
