// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/edge_lengths.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "palpate/base/number.h"

namespace palpate::mesh {
namespace {

constexpr double kBounds[] = {1.0, 1.5, 2.0, 3.0, 5.0, 7.0};
constexpr int kBoundsADecade = 6;

/// Bound number `k`, with bound 0 at 1 m, as the exact decimal number.
double bound(int k) {
  const int decade = static_cast<int>(std::floor(static_cast<double>(k) / kBoundsADecade));
  const std::string text =
      formatNumber(kBounds[k - kBoundsADecade * decade]) + "e" + std::to_string(decade);
  return parseNumber(text).value_or(0.0);
}

/// Class of `length` > 0.
int classOf(double length) {
  int k = kBoundsADecade * static_cast<int>(std::floor(std::log10(length)));
  while (bound(k) > length) --k;
  while (bound(k + 1) <= length) ++k;
  return k;
}

}  // namespace

EdgeLengths measureEdges(const CellMesh& mesh) {
  EdgeLengths result;
  std::vector<double> lengths;
  for (const auto& [i, j] : edgesOf(mesh)) {
    lengths.push_back((mesh.points.col(i) - mesh.points.col(j)).norm());
  }
  if (lengths.empty()) return result;
  result.mean =
      std::accumulate(lengths.begin(), lengths.end(), 0.0) / static_cast<double>(lengths.size());
  std::sort(lengths.begin(), lengths.end());
  result.least = lengths.front();
  result.largest = lengths.back();
  if (!(result.least > 0.0)) return result;
  auto first = lengths.begin();
  for (int k = classOf(result.least); first != lengths.end(); ++k) {
    const auto last = std::lower_bound(first, lengths.end(), bound(k + 1));
    result.classes.push_back({bound(k), bound(k + 1), static_cast<int>(last - first)});
    first = last;
  }
  return result;
}

}  // namespace palpate::mesh
