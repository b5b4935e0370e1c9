// SPDX-License-Identifier: GPL-3.0-or-later
#include "moving_region.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpate::tissue {

MovingRegion::MovingRegion(const Points& X, double radius, std::vector<int> a, std::vector<int> b)
    : X_(X),
      radius_(radius),
      a_(std::move(a)),
      b_(std::move(b)),
      moves_(static_cast<std::size_t>(X.cols()), 0),
      centres_(static_cast<std::size_t>(X.cols()), 0) {
  points_.reserve(moves_.size());
  springs_.reserve(a_.size());
  setAll();
}

void MovingRegion::addAround(const std::vector<int>& touched) {
  if (whole()) return;
  bool more = false;
  for (const int c : touched) {
    if (std::exchange(centres_[static_cast<std::size_t>(c)], 1)) continue;
    for (Eigen::Index i = 0; i < X_.cols(); ++i) {
      if ((X_.col(i) - X_.col(c)).squaredNorm() > radius_ * radius_) continue;
      more = !std::exchange(moves_[static_cast<std::size_t>(i)], 1) || more;
    }
  }
  if (more) list();
}

void MovingRegion::setAll() {
  std::fill(moves_.begin(), moves_.end(), 1);
  list();
}

void MovingRegion::clear() {
  if (!std::isfinite(radius_)) return;
  std::fill(moves_.begin(), moves_.end(), 0);
  std::fill(centres_.begin(), centres_.end(), 0);
  list();
}

void MovingRegion::list() {
  points_.clear();
  springs_.clear();
  for (std::size_t i = 0; i < moves_.size(); ++i) {
    if (moves_[i]) points_.push_back(static_cast<int>(i));
  }
  for (std::size_t s = 0; s < a_.size(); ++s) {
    if (moves(a_[s]) || moves(b_[s])) springs_.push_back(static_cast<int>(s));
  }
}

void MovingRegion::save(StateWriter* out) const {
  out->put(moves_);
  out->put(centres_);
}

void MovingRegion::restore(StateReader* in) {
  in->getSame(&moves_);
  in->getSame(&centres_);
  list();
}

}  // namespace palpate::tissue
