// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiled_cholesky.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>
#include <vector>

#include "palpate/base/for_all.h"

namespace palpate::bem {
namespace {

constexpr Eigen::Index kTile = 192, kColumns = 96;

Eigen::Index tiles(Eigen::Index size) { return (size + kTile - 1) / kTile; }

// Tiles of the lower triangle from tile `first`, row and column.
std::vector<std::pair<Eigen::Index, Eigen::Index>> lowerTiles(Eigen::Index first,
                                                              Eigen::Index count) {
  std::vector<std::pair<Eigen::Index, Eigen::Index>> found;
  for (Eigen::Index j = first; j < count; ++j) {
    for (Eigen::Index i = j; i < count; ++i) found.emplace_back(i, j);
  }
  return found;
}

}  // namespace

bool factorise(Eigen::MatrixXd* A, ThreadPool* pool) {
  const Eigen::Index size = A->rows(), count = tiles(size);
  const auto tile = [&](Eigen::Index i, Eigen::Index j) {
    return A->block(i * kTile, j * kTile, std::min(kTile, size - i * kTile),
                    std::min(kTile, size - j * kTile));
  };
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::LLT<Eigen::MatrixXd> factor(tile(k, k));
    if (factor.info() != Eigen::Success) return false;
    tile(k, k).triangularView<Eigen::Lower>() = factor.matrixLLT();
    forAll(pool, static_cast<std::size_t>(count - k - 1), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        auto below = tile(k + 1 + static_cast<Eigen::Index>(i), k);
        factor.matrixL().transpose().solveInPlace<Eigen::OnTheRight>(below);
      }
    });
    const auto rest = lowerTiles(k + 1, count);
    forAll(pool, rest.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        const auto [i, j] = rest[t];
        tile(i, j).noalias() -= tile(i, k) * tile(j, k).transpose();
      }
    });
  }
  return true;
}

void solveLower(const Eigen::MatrixXd& L, Eigen::MatrixXd* X, ThreadPool* pool) {
  const Eigen::Index parts = (X->cols() + kColumns - 1) / kColumns;
  forAll(pool, static_cast<std::size_t>(parts), [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      const Eigen::Index first = static_cast<Eigen::Index>(p) * kColumns;
      auto columns = X->middleCols(first, std::min(kColumns, X->cols() - first));
      L.triangularView<Eigen::Lower>().solveInPlace(columns);
    }
  });
}

void addSquare(const Eigen::MatrixXd& X, Eigen::MatrixXd* S, ThreadPool* pool) {
  const auto all = lowerTiles(0, tiles(S->rows()));
  const auto columns = [&](Eigen::Index t) {
    return X.middleCols(t * kTile, std::min(kTile, X.cols() - t * kTile));
  };
  forAll(pool, all.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const auto [i, j] = all[t];
      const auto left = columns(i), right = columns(j);
      S->block(i * kTile, j * kTile, left.cols(), right.cols()).noalias() +=
          left.transpose() * right;
    }
  });
}

}  // namespace palpate::bem
