// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "kernels/tet_batch.h"
#include "palpate/base/types.h"

namespace palpate::fem {

inline Mat3 tensorAt(const SymmetricBatch& batch, int lane) {
  const auto& c = batch.component;
  Mat3 T;
  T << c[0][lane], c[3][lane], c[5][lane],  //
      c[3][lane], c[1][lane], c[4][lane],   //
      c[5][lane], c[4][lane], c[2][lane];
  return T;
}
inline void setTensorAt(const Mat3& T, SymmetricBatch* batch, int lane) {
  auto& c = batch->component;
  for (int i = 0; i < 3; ++i) {
    c[i][lane] = T(i, i);
    c[3 + i][lane] = T(i, (i + 1) % 3);
  }
}

/// Copy-on-write tensors at points. A copy that is rewritten gets its own memory and keeps it for
/// later. For copies in one thread.
class SharedBatches {
 public:
  SharedBatches() : SharedBatches(0) {}
  /// All tensors zero.
  explicit SharedBatches(std::size_t count)
      : now_(std::make_shared<std::vector<SymmetricBatch>>(count)) {}
  SharedBatches(const SharedBatches& other) : now_(other.now_) {}
  SharedBatches& operator=(const SharedBatches& other) {
    if (this == &other || now_ == other.now_) return *this;
    spare_ = std::move(now_);
    now_ = other.now_;
    return *this;
  }

  std::size_t size() const { return now_->size(); }
  const SymmetricBatch* data() const { return now_->data(); }

  struct Rewrite {
    const SymmetricBatch* before;  ///< Previous values.
    SymmetricBatch* now;           ///< Destination, to be written completely; may equal `before`.
  };
  Rewrite rewrite() {
    if (now_.use_count() == 1) return {now_->data(), now_->data()};
    if (!spare_ || spare_.use_count() > 1 || spare_->size() != now_->size()) {
      spare_ = std::make_shared<std::vector<SymmetricBatch>>(now_->size());
    }
    std::swap(now_, spare_);
    return {spare_->data(), now_->data()};
  }

 private:
  std::shared_ptr<std::vector<SymmetricBatch>> now_, spare_;
};

}  // namespace palpate::fem
