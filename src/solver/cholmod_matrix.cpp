// SPDX-License-Identifier: GPL-3.0-or-later
#include "cholmod_matrix.h"

#include <utility>

namespace palpate::solver {
namespace {

// Rows of the lower triangle in column 3 i + c. Block column i of the lower triangle is block row
// i of the upper one, transposed.
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

// Blocks only; where there are volumes, of the pattern that holds them too.
class AssembledMatrix final : public CholmodMatrix {
 public:
  AssembledMatrix(const fem::Stiffness& A, cholmod_common* common) : CholmodMatrix(common) {
    if (A.hasVolume()) widen(A);
    const fem::BlockMatrix& pattern = A.hasVolume() ? wide_ : A.blocks();
    std::vector<std::vector<int>> rows(3 * static_cast<std::size_t>(A.numNodes()));
    for (int i = 0; i < A.numNodes(); ++i) {
      for (int c = 0; c < 3; ++c) appendBlockRows(pattern, i, c, &rows[3 * i + c]);
    }
    allocate(rows);
  }

  void assign(const fem::Stiffness& A) override {
    if (A.hasVolume()) assembleVolumes(A);
    const fem::BlockMatrix& blocks = A.hasVolume() ? wide_ : A.blocks();
    double* value = values();
    for (int i = 0; i < blocks.numNodes(); ++i) {
      for (int c = 0; c < 3; ++c) value = copyBlockRows(blocks, i, c, value);
    }
  }

 private:
  void widen(const fem::Stiffness& A) {
    const fem::VolumeStiffness::Pattern& pattern = *A.volume().pattern;
    std::vector<std::pair<int, int>> pairs;
    for (std::size_t p = 0; p + 1 < pattern.start.size(); ++p) {
      for (int k = pattern.start[p]; k < pattern.start[p + 1]; ++k) {
        for (int l = k + 1; l < pattern.start[p + 1]; ++l) {
          pairs.emplace_back(pattern.node[k], pattern.node[l]);
        }
      }
    }
    wide_ = fem::BlockMatrix(A.numNodes(), pairs);
    for (std::size_t p = 0; p + 1 < pattern.start.size(); ++p) {
      for (int k = pattern.start[p]; k < pattern.start[p + 1]; ++k) {
        for (int l = k; l < pattern.start[p + 1]; ++l) {
          slot_.push_back(wide_.find(pattern.node[k], pattern.node[l]));
        }
      }
    }
  }

  // Into the upper triangle, which is all that is copied.
  void assembleVolumes(const fem::Stiffness& A) {
    wide_.setZero();
    const fem::BlockMatrix& blocks = A.blocks();
    for (int i = 0; i < blocks.numNodes(); ++i) {
      int wide_slot = wide_.diagonal(i);
      for (int slot = blocks.diagonal(i); slot < blocks.rowEnd(i); ++slot) {
        while (wide_.column(wide_slot) != blocks.column(slot)) ++wide_slot;
        wide_.block(wide_slot) = blocks.block(slot);
      }
    }
    const fem::VolumeStiffness& volume = A.volume();
    const std::vector<int>& start = volume.pattern->start;
    auto slot = slot_.begin();
    for (Eigen::Index p = 0; p < volume.numRows(); ++p) {
      const double weight = volume.factor * volume.metric->weights()[p];
      for (int k = start[p]; k < start[p + 1]; ++k) {
        const Vec3 b = weight * volume.rows.col(k);
        for (int l = k; l < start[p + 1]; ++l) {
          wide_.block(*slot++) += b * volume.rows.col(l).transpose();
        }
      }
    }
  }

  fem::BlockMatrix wide_;
  std::vector<int> slot_;  // in wide_, of the pairs of entries of the volumes, one after another
};

class MixedMatrix final : public CholmodMatrix {
 public:
  MixedMatrix(const fem::Stiffness& A, cholmod_common* common) : CholmodMatrix(common) {
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
        appendBlockRows(A.blocks(), i, c, &rows[3 * i + c]);
        for (const Entry& entry : entries_[i]) rows[3 * i + c].push_back(n + entry.pressure);
      }
    }
    forLowerCompliance(volume, [&](int column, int row, double) {
      rows[static_cast<std::size_t>(n + column)].push_back(n + row);
    });
    allocate(rows);
  }

  int numPressures() const override { return num_pressures_; }

  void assign(const fem::Stiffness& A) override {
    const fem::VolumeStiffness& volume = A.volume();
    double* value = values();
    for (int i = 0; i < A.numNodes(); ++i) {
      for (int c = 0; c < 3; ++c) {
        value = copyBlockRows(A.blocks(), i, c, value);
        for (const Entry& entry : entries_[i]) *value++ = volume.rows(c, entry.index);
      }
    }
    forLowerCompliance(volume, [&](int, int, double a) { *value++ = -a / volume.factor; });
  }

 private:
  struct Entry {
    int pressure, index;  // of the volumes' rows
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

std::unique_ptr<CholmodMatrix> makeCholmodMatrix(const fem::Stiffness& A, cholmod_common* common) {
  if (A.hasVolume() && !A.volume().metric->isDiagonal()) {
    return std::make_unique<MixedMatrix>(A, common);
  }
  return std::make_unique<AssembledMatrix>(A, common);
}

}  // namespace palpate::solver
