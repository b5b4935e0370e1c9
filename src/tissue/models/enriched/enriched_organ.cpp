// SPDX-License-Identifier: GPL-3.0-or-later
#include "enriched_organ.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "palpate/base/state_bytes.h"

namespace palpate::tissue {
namespace {

// Largest fraction of a detail's change per cycle [-]: detail lags by a cycle, and would oscillate
// where it exceeds the body's displacement.
constexpr double kLargestPart = 0.25;
// Change of detail that counts as zero, over the body's size [-].
constexpr double kStill = 1e-7;

}  // namespace

EnrichedOrgan::EnrichedOrgan(std::unique_ptr<FemOrgan> body, FineSurface fine,
                             LearnedDetail learned, double time)
    : body_(std::move(body)),
      fine_(std::move(fine)),
      learned_(std::move(learned)),
      time_(time),
      still_(kStill * body_->body().size),
      equilibrium_(body_->body().x),
      triangles_(fine_.triangles().array() + static_cast<int>(equilibrium_.cols())),
      detail_(Points::Zero(3, fine_.numPoints())),
      rate_(detail_),
      x_(3, equilibrium_.cols() + fine_.numPoints()),
      v_(x_) {
  EnrichedOrgan::reset();
}

mesh::CellMesh EnrichedOrgan::cells(int) const {
  mesh::CellMesh cells;
  cells.points.resize(3, x_.cols());
  cells.points << body_->body().mesh.points, fine_.rest();
  cells.cells = triangles_;
  return cells;
}

const TissueStep& EnrichedOrgan::endCycle(const std::vector<contact::Obstacle>&, double dt) {
  const TissueStep& report = body_->report();
  if (report.slept) return report;
  u_ = body_->body().x - equilibrium_;
  learned_.find(report.contacts, u_, fine_, &target_);
  if (follow(dt)) {
    fine_.offsets(detail_, &offsets_);
    body_->setContactOffsets(offsets_);
    body_->wake();
  }
  show();
  return report;
}

// Updates the detail. Returns whether it changed.
bool EnrichedOrgan::follow(double dt) {
  const double part = std::min(-std::expm1(-dt / time_), kLargestPart);
  target_ -= detail_;
  const double way = part * std::sqrt(target_.colwise().squaredNorm().maxCoeff());
  if (!(way > still_)) {
    rate_.setZero();
    return false;
  }
  rate_ = (part / dt) * target_;
  detail_ += part * target_;
  return true;
}

void EnrichedOrgan::show() {
  const Eigen::Index m = equilibrium_.cols(), n = fine_.numPoints();
  x_.leftCols(m) = body_->body().x;
  v_.leftCols(m) = body_->body().v;
  fine_.carried(body_->body().x, &on_);
  x_.rightCols(n) = on_ + fine_.distance() + detail_;
  fine_.carried(body_->body().v, &on_);
  v_.rightCols(n) = on_ + rate_;
}

void EnrichedOrgan::reset() {
  body_->reset();
  detail_.setZero();
  rate_.setZero();
  fine_.offsets(detail_, &offsets_);
  body_->setContactOffsets(offsets_);
  show();
}

void EnrichedOrgan::setPositions(int, const Points& positions, const Points& velocities) {
  const Eigen::Index m = equilibrium_.cols(), n = fine_.numPoints();
  body_->setPositions(0, positions.leftCols(m), velocities.leftCols(m));
  fine_.carried(body_->body().x, &on_);
  detail_ = positions.rightCols(n) - on_ - fine_.distance();
  rate_.setZero();
  fine_.offsets(detail_, &offsets_);
  body_->setContactOffsets(offsets_);
  show();
}

std::string EnrichedOrgan::kind() const {
  return "enriched, " + std::to_string(fine_.numPoints()) + " fine points";
}

State EnrichedOrgan::state() const {
  StateWriter out;
  const State inner = body_->state();
  out.put(inner.kind);
  out.put(inner.bytes);
  out.put(detail_);
  out.put(rate_);
  return {kind(), out.bytes()};
}

void EnrichedOrgan::restore(const State& state) {
  checkKind(state, kind());
  StateReader in(state.bytes);
  State inner;
  in.get(&inner.kind);
  in.get(&inner.bytes);
  in.getSame(&detail_);
  in.getSame(&rate_);
  in.finish();
  if (!detail_.allFinite() || !rate_.allFinite()) {
    throw std::invalid_argument("the state is not finite");
  }
  body_->restore(inner);
  fine_.offsets(detail_, &offsets_);
  body_->setContactOffsets(offsets_);
  show();
}

}  // namespace palpate::tissue
