// SPDX-License-Identifier: GPL-3.0-or-later
// Viscous memory: transfer to another mesh, and serialisation.
#include <stdexcept>

#include "point_change.h"
#include "prony_history.h"

namespace palpate::fem {

// Tensors of a point in the order of their bytes: S, H, then Q of each term.

int PronyHistory::numTensors(int batch) const {
  return 2 + static_cast<int>(terms(batches_[batch]).size());
}

const SymmetricBatch& PronyHistory::tensors(int batch, int k) const {
  if (k >= 2) return state_.Q.data()[batches_[batch].first_Q + k - 2];
  return (k == 0 ? state_.S : state_.H).data()[batch];
}

template <class TensorAt>
void PronyHistory::setAll(const TensorAt& tensor) {
  SymmetricBatch *S = state_.S.rewrite().now, *H = state_.H.rewrite().now,
                 *Q = state_.Q.rewrite().now;
  for (int e = 0; e < static_cast<int>(first_slot_.size()); ++e) {
    for (int q = 0; q < points_per_element_; ++q) {
      if (first_slot_[e] < 0) {
        tensor(e, q, 0);
        tensor(e, q, 1);
        continue;
      }
      const Slot at = slot(e, q);
      setTensorAt(tensor(e, q, 0), &S[at.batch], at.lane);
      setTensorAt(tensor(e, q, 1), &H[at.batch], at.lane);
      for (int k = 2; k < numTensors(at.batch); ++k) {
        setTensorAt(tensor(e, q, k), &Q[batches_[at.batch].first_Q + k - 2], at.lane);
      }
    }
  }
}

void PronyHistory::goOnFrom(const PronyHistory& old, const mesh::MeshChange& change,
                            const std::vector<double>& old_volumes) {
  const auto fail = [] { throw std::invalid_argument("the body was of other solids"); };
  if (empty() != old.empty() || state_.terms.size() != old.state_.terms.size()) fail();
  state_.terms = old.state_.terms;
  state_.factor = old.state_.factor;
  if (empty()) return;
  const PointChange from(change, points_per_element_, old_volumes);
  setAll([&](int e, int q, int k) -> Mat3 {
    if (first_slot_[e] < 0) return Mat3::Zero();
    const int solid = batches_[batchOf(e)].solid;
    const auto before = [&](const PointChange::Source& source) {
      const int batch = old.batchOf(source.element);
      if (batch < 0 || old.batches_[batch].solid != solid) fail();
      const Slot at = old.slot(source.element, source.point);
      return tensorAt(old.tensors(at.batch, k), at.lane);
    };
    const PointChange::Sources sources = from.sources(e, q);
    if (sources.isCopy()) return before(*sources.begin());
    Mat3 sum = Mat3::Zero();
    for (const PointChange::Source& source : sources) sum += source.weight * before(source);
    return sum;
  });
}

void PronyHistory::save(StateWriter* out) const {
  const std::size_t num_points = first_slot_.size() * points_per_element_;
  out->put(static_cast<std::int64_t>(num_points));
  if (empty()) return;
  out->put(state_.factor);
  for (const std::vector<Term>& terms : state_.terms) {
    for (const Term& term : terms) {
      out->put(term.decay);
      out->put(term.gain);
    }
  }
  for (int e = 0; e < static_cast<int>(first_slot_.size()); ++e) {
    for (int q = 0; q < points_per_element_; ++q) {
      if (first_slot_[e] < 0) {  // S, H
        out->put(Mat3::Zero().eval());
        out->put(Mat3::Zero().eval());
        continue;
      }
      const Slot at = slot(e, q);
      for (int k = 0; k < numTensors(at.batch); ++k) {
        out->put(tensorAt(tensors(at.batch, k), at.lane));
      }
    }
  }
}

void PronyHistory::restore(StateReader* in) {
  const std::size_t num_points = first_slot_.size() * points_per_element_;
  if (in->count(1) != static_cast<std::int64_t>(num_points)) StateReader::fail();
  if (empty()) return;
  in->getSame(&state_.factor);
  for (std::vector<Term>& terms : state_.terms) {
    for (Term& term : terms) {
      in->get(&term.decay);
      in->get(&term.gain);
    }
  }
  setAll([&](int, int, int) {
    Mat3 tensor;
    in->get(&tensor);
    return tensor;
  });
}

}  // namespace palpate::fem
