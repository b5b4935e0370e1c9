// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

namespace palpate::fem {

/// Sources of each sum: target k has begin(k) .. end(k), in the order of listing.
template <class Source>
class Sources {
 public:
  Sources() = default;
  /// Source s contributes to target `targets[s]` in [0, num_targets).
  Sources(const std::vector<int>& targets, const std::vector<Source>& sources, int num_targets)
      : start_(static_cast<std::size_t>(num_targets) + 1, 0), sources_(sources.size()) {
    for (int k : targets) ++start_[k + 1];
    for (int k = 0; k < num_targets; ++k) start_[k + 1] += start_[k];
    std::vector<int> next(start_.begin(), start_.end() - 1);
    for (std::size_t s = 0; s < sources.size(); ++s) sources_[next[targets[s]]++] = sources[s];
  }

  std::size_t numTargets() const { return start_.size() - 1; }
  const Source* begin(std::size_t k) const { return sources_.data() + start_[k]; }
  const Source* end(std::size_t k) const { return sources_.data() + start_[k + 1]; }

 private:
  std::vector<int> start_{0};
  std::vector<Source> sources_;
};

}  // namespace palpate::fem
