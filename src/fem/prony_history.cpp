// SPDX-License-Identifier: GPL-3.0-or-later
#include "prony_history.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/base/for_all.h"

namespace palpate::fem {
namespace {

// All numbers of a batch.
using Values = Eigen::Array<double, 6 * kBatchSize, 1>;
Eigen::Map<const Values> values(const SymmetricBatch& batch) {
  return Eigen::Map<const Values>(batch.component[0]);
}
Eigen::Map<Values> values(SymmetricBatch& batch) { return Eigen::Map<Values>(batch.component[0]); }

}  // namespace

PronyHistory::PronyHistory(const Composition& composition, const std::vector<ElementRun>& runs,
                           int num_elements, int points_per_element, ThreadPool* pool)
    : points_per_element_(points_per_element), pool_(pool) {
  for (const material::Solid& solid : composition.solids) {
    material::checkProny(solid.law, solid.prony);
    state_.terms.emplace_back();
    for (const material::PronyTerm& term : solid.prony) {
      state_.terms.back().push_back({term.g, term.tau, 0.0, 0.0});
      viscous_ = true;
    }
  }
  state_.factor.assign(state_.terms.size(), 1.0);
  if (viscous_) {
    first_slot_.assign(static_cast<std::size_t>(num_elements), -1);
    for (const ElementRun& run : runs) addBatches(run);
    S_end_.resize(batches_.size());
    state_.S = state_.H = SharedBatches(batches_.size());
  }
  setTerms(std::numeric_limits<double>::infinity());  // H = 0
}

void PronyHistory::addBatches(const ElementRun& run) {
  if (!isViscous(run.solid)) return;
  const auto first = static_cast<int>(kBatchSize * batches_.size());
  const auto num_elements = static_cast<int>(run.elements.size());
  for (int k = 0; k < num_elements; ++k) {
    first_slot_[run.elements[k]] = first + points_per_element_ * k;
  }
  auto num_Q = static_cast<int>(state_.Q.size());
  for (int k = 0; k < points_per_element_ * num_elements; k += kBatchSize) {
    batches_.push_back({run.solid, num_Q});
    num_Q += static_cast<int>(state_.terms[run.solid].size());
  }
  state_.Q = SharedBatches(static_cast<std::size_t>(num_Q));
}

PronyHistory::Slot PronyHistory::slot(int e, int q) const {
  const int at = first_slot_[e] + q;
  return {at / kBatchSize, at % kBatchSize};
}

int PronyHistory::batchOf(int e) const { return first_slot_[e] < 0 ? -1 : slot(e, 0).batch; }

Mat3 PronyHistory::stress(int e, int q) const {
  if (first_slot_[e] < 0) return Mat3::Zero();
  return tensorAt(state_.H.data()[slot(e, q).batch], slot(e, q).lane);
}

void PronyHistory::setStressAtEnd(int e, int q, const Mat3& S) {
  setTensorAt(S, &S_end_[slot(e, q).batch], slot(e, q).lane);
}

void PronyHistory::setTerms(double h) {
  for (std::size_t solid = 0; solid < state_.terms.size(); ++solid) {
    state_.factor[solid] = 1.0;
    for (Term& term : state_.terms[solid]) {
      const double x = h / term.tau;
      term.decay = std::exp(-x);
      term.gain = term.g * (x > 1e-8 ? -std::expm1(-x) / x : 1.0 - 0.5 * x);
      state_.factor[solid] += term.gain - term.g;
    }
  }
}

void PronyHistory::beginStep(double h) {
  setTerms(h);
  const SymmetricBatch *S = state_.S.data(), *Q = state_.Q.data();
  SymmetricBatch* H = state_.H.rewrite().now;
  forAll(pool_, batches_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const std::vector<Term>& terms = this->terms(batches_[b]);
      Values sum = Values::Zero();
      for (std::size_t k = 0; k < terms.size(); ++k) {
        sum += terms[k].decay * values(Q[batches_[b].first_Q + k]) - terms[k].gain * values(S[b]);
      }
      values(H[b]) = sum;
    }
  });
}

void PronyHistory::endStep() {
  const SharedBatches::Rewrite S = state_.S.rewrite(), Q = state_.Q.rewrite();
  forAll(pool_, batches_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const std::vector<Term>& terms = this->terms(batches_[b]);
      const Values change = values(S_end_[b]) - values(S.before[b]);
      for (std::size_t k = 0; k < terms.size(); ++k) {
        const std::size_t at = batches_[b].first_Q + k;
        values(Q.now[at]) = terms[k].decay * values(Q.before[at]) + terms[k].gain * change;
      }
      S.now[b] = S_end_[b];
    }
  });
}

void PronyHistory::relax() {
  std::copy(S_end_.begin(), S_end_.end(), state_.S.rewrite().now);
  std::fill_n(state_.Q.rewrite().now, state_.Q.size(), SymmetricBatch{});
}

}  // namespace palpate::fem
