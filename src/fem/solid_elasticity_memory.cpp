// SPDX-License-Identifier: GPL-3.0-or-later
// Viscous state of a body: steps, saving, mesh changes.
#include <limits>
#include <stdexcept>

#include "solid_elasticity.h"

namespace palpate::fem {

template <int N>
void SolidElasticity<N>::memoryChanged() {
  if (packed_) packed_->forgetMemory();
}

template <int N>
void SolidElasticity<N>::beginStep(double h) {
  if (!viscous()) return;
  history_->beginStep(h);
  memoryChanged();
}

template <int N>
void SolidElasticity<N>::endStep(const Points& x) {
  if (!viscous()) return;
  remember(x);
  history_->endStep();
}

template <int N>
void SolidElasticity<N>::relax(const Points& x) {
  if (!viscous()) return;
  remember(x);
  history_->relax();
  beginStep(std::numeric_limits<double>::infinity());
}

template <int N>
void SolidElasticity<N>::remember(const Points& x) {
  if (packed_) return packed_->distortionalStresses(x, history_->stressesAtEnd());
  forBatches(x, [&](const Batch& batch) {
    if (!batch.points.H) return;
    Mat3 S[kBatch * kPoints];
    distortionalStresses(*batch.law, batch.points.count, batch.F, S);
    for (int k = 0; k < batch.count; ++k) {
      for (int q = 0; q < kPoints; ++q) {
        history_->setStressAtEnd(batch.elements[k], q, S[batch.point(k, q)]);
      }
    }
  });
}

template <int N>
void SolidElasticity<N>::goOnFrom(const Elasticity& old, const mesh::MeshChange& change) {
  const auto* same = dynamic_cast<const SolidElasticity*>(&old);
  if (!same) throw std::invalid_argument("the body was of other elements");
  history_->goOnFrom(*same->history_, change, same->shape_.volumes);
  memoryChanged();
}

template <int N>
std::unique_ptr<ViscousState> SolidElasticity<N>::saveViscousState() const {
  if (!viscous()) return nullptr;
  return std::make_unique<SavedHistory>(history_->state());
}

template <int N>
void SolidElasticity<N>::restoreViscousState(const ViscousState* state) {
  const auto* saved = dynamic_cast<const SavedHistory*>(state);
  if (!saved) return;
  history_->setState(saved->state);
  memoryChanged();
}

template <int N>
void SolidElasticity<N>::restore(StateReader* in) {
  history_->restore(in);
  memoryChanged();
}

template void SolidElasticity<4>::beginStep(double);
template void SolidElasticity<4>::endStep(const Points&);
template void SolidElasticity<4>::relax(const Points&);
template void SolidElasticity<4>::goOnFrom(const Elasticity&, const mesh::MeshChange&);
template std::unique_ptr<ViscousState> SolidElasticity<4>::saveViscousState() const;
template void SolidElasticity<4>::restoreViscousState(const ViscousState*);
template void SolidElasticity<4>::restore(StateReader*);

template void SolidElasticity<10>::beginStep(double);
template void SolidElasticity<10>::endStep(const Points&);
template void SolidElasticity<10>::relax(const Points&);
template void SolidElasticity<10>::goOnFrom(const Elasticity&, const mesh::MeshChange&);
template std::unique_ptr<ViscousState> SolidElasticity<10>::saveViscousState() const;
template void SolidElasticity<10>::restoreViscousState(const ViscousState*);
template void SolidElasticity<10>::restore(StateReader*);

}  // namespace palpate::fem
