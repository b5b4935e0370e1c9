// SPDX-License-Identifier: GPL-3.0-or-later
#include "packed_rows.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace palpate::solver {
namespace {

constexpr std::size_t kPadding = 16;  // floats that a kernel may read beyond the end

}  // namespace

PackedRows::PackedRows(const std::vector<std::vector<Entry>>& rows, int size, unsigned stride,
                       const std::vector<std::vector<Entry>>& like)
    : size_(size), target_(rows.size()), start_{0} {
  std::iota(target_.begin(), target_.end(), 0);
  for (std::size_t begin = 0; begin < rows.size(); begin += kChunk) {
    const auto first = target_.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last =
        target_.begin() + static_cast<std::ptrdiff_t>(std::min(begin + kChunk, rows.size()));
    std::stable_sort(first, last, [&](int a, int b) { return like[a].size() < like[b].size(); });
  }
  for (int target : target_) {
    for (const Entry& entry : rows[target]) {
      source_.push_back(stride * static_cast<unsigned>(entry.source));
      from_.push_back(entry.from);
    }
    if (rows[target].size() % 2 != 0) {
      source_.push_back(source_.back());
      from_.push_back(-1);
    }
    start_.push_back(static_cast<int>(source_.size()));
  }
  values_.assign(static_cast<std::size_t>(size_) * source_.size() + kPadding, 0.0F);
}

void PackedRows::assign(int chunk, const double* values, const PcgKernels& kernels) {
  const int last = std::min(kChunk * (chunk + 1), static_cast<int>(target_.size()));
  const auto pack = size_ == 9 ? kernels.pack9 : kernels.pack3;
  pack(from_.data(), start_[kChunk * chunk], start_[last], values, values_.data());
}

}  // namespace palpate::solver
