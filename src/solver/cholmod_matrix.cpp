// SPDX-License-Identifier: GPL-3.0-or-later
#include "cholmod_matrix.h"

#include "gathered_blocks.h"

namespace palpate::solver {
namespace {

// Rows of the lower triangle in column 3 i + c. Block column i of the lower triangle is the
// transposed block row i of the upper one.
void appendBlockRows(const fem::BlockMatrix& A, int i, int c, std::vector<int>* rows) {
  for (int slot = A.diagonal(i); slot < A.rowEnd(i); ++slot) {
    for (int r = slot == A.diagonal(i) ? c : 0; r < 3; ++r) rows->push_back(3 * A.column(slot) + r);
  }
}

double* copyBlockRows(const fem::BlockMatrix& A, int i, int c, double* value) {
  for (int slot = A.diagonal(i); slot < A.rowEnd(i); ++slot) {
    const auto block = A.block(slot);
    for (int r = slot == A.diagonal(i) ? c : 0; r < 3; ++r) *value++ = block(c, r);
  }
  return value;
}

class AssembledMatrix final : public CholmodMatrix {
 public:
  AssembledMatrix(const fem::Stiffness& A, GatheredBlocks blocks, cholmod_common* common)
      : CholmodMatrix(common), blocks_(std::move(blocks)) {
    std::vector<std::vector<int>> rows(3 * static_cast<std::size_t>(A.numNodes()));
    for (int i = 0; i < A.numNodes(); ++i) {
      for (int c = 0; c < 3; ++c) appendBlockRows(blocks_.pattern(A), i, c, &rows[3 * i + c]);
    }
    allocate(rows);
  }

  bool fits(const fem::Stiffness& A) const override { return blocks_.fits(A); }
  std::unique_ptr<CholmodMatrix> coupled(const fem::Stiffness& A) const override {
    return std::make_unique<AssembledMatrix>(A, GatheredBlocks(blocks_, A), common());
  }

  void assign(const fem::Stiffness& A) override {
    const fem::BlockMatrix& blocks = blocks_.gather(A);
    double* value = values();
    for (int i = 0; i < blocks.numNodes(); ++i) {
      for (int c = 0; c < 3; ++c) value = copyBlockRows(blocks, i, c, value);
    }
  }

 private:
  GatheredBlocks blocks_;
};

class MixedMatrix final : public CholmodMatrix {
 public:
  MixedMatrix(const fem::Stiffness& A, GatheredBlocks blocks, cholmod_common* common)
      : CholmodMatrix(common), blocks_(std::move(blocks)) {
    const fem::VolumeStiffness& volume = A.volume();
    const fem::VolumeStiffness::Pattern& pattern = *volume.pattern;
    num_pressures_ = static_cast<int>(volume.numRows());
    const int n = 3 * A.numNodes();
    entries_.resize(static_cast<std::size_t>(A.numNodes()));
    for (int p = 0; p < num_pressures_; ++p) {
      for (int k = pattern.start[p]; k < pattern.start[p + 1]; ++k) {
        entries_[pattern.node[k]].push_back({p, k});
      }
    }
    std::vector<std::vector<int>> rows(static_cast<std::size_t>(n + num_pressures_));
    for (int i = 0; i < A.numNodes(); ++i) {
      for (int c = 0; c < 3; ++c) {
        appendBlockRows(blocks_.pattern(A), i, c, &rows[3 * i + c]);
        for (const Entry& entry : entries_[i]) rows[3 * i + c].push_back(n + entry.pressure);
      }
    }
    forLowerCompliance(volume, [&](int column, int row, double) {
      rows[static_cast<std::size_t>(n + column)].push_back(n + row);
    });
    allocate(rows);
  }

  int numPressures() const override { return num_pressures_; }
  bool fits(const fem::Stiffness& A) const override { return blocks_.fits(A); }
  std::unique_ptr<CholmodMatrix> coupled(const fem::Stiffness& A) const override {
    return std::make_unique<MixedMatrix>(A, GatheredBlocks(blocks_, A), common());
  }

  void assign(const fem::Stiffness& A) override {
    const fem::VolumeStiffness& volume = A.volume();
    const fem::BlockMatrix& blocks = blocks_.gather(A);
    double* value = values();
    for (int i = 0; i < A.numNodes(); ++i) {
      for (int c = 0; c < 3; ++c) {
        value = copyBlockRows(blocks, i, c, value);
        for (const Entry& entry : entries_[i]) *value++ = volume.rows(c, entry.index);
      }
    }
    forLowerCompliance(volume, [&](int, int, double a) { *value++ = -a / volume.factor; });
  }

 private:
  struct Entry {
    int pressure, index;  // in the rows of the volume stiffness
  };

  template <class Visit>
  static void forLowerCompliance(const fem::VolumeStiffness& volume, const Visit& visit) {
    const Eigen::SparseMatrix<double>& A = volume.metric->compliance();
    for (int column = 0; column < A.outerSize(); ++column) {
      for (Eigen::SparseMatrix<double>::InnerIterator it(A, column); it; ++it) {
        if (it.row() >= column) visit(column, static_cast<int>(it.row()), it.value());
      }
    }
  }

  GatheredBlocks blocks_;
  int num_pressures_ = 0;
  std::vector<std::vector<Entry>> entries_;  // of each node
};

}  // namespace

void CholmodMatrix::allocate(const std::vector<std::vector<int>>& rows) {
  std::size_t size = 0;
  for (const std::vector<int>& column : rows) size += column.size();
  sparse_ =
      cholmod_allocate_sparse(rows.size(), rows.size(), size, 1, 1, -1, CHOLMOD_REAL, common_);
  owner_ = {sparse_, Free{common_}};
  auto* start = static_cast<int*>(sparse_->p);
  auto* row = static_cast<int*>(sparse_->i);
  *start = 0;
  for (const std::vector<int>& column : rows) {
    for (int r : column) *row++ = r;
    start[1] = start[0] + static_cast<int>(column.size());
    ++start;
  }
}

std::unique_ptr<CholmodMatrix> makeCholmodMatrix(const fem::Stiffness& A, Volumes volumes,
                                                 cholmod_common* common) {
  const bool included = A.hasVolume() && volumes == Volumes::kIncluded;
  if (included && !A.volume().metric->isDiagonal()) {
    return std::make_unique<MixedMatrix>(A, GatheredBlocks(A, false), common);
  }
  return std::make_unique<AssembledMatrix>(A, GatheredBlocks(A, included), common);
}

}  // namespace palpate::solver
