// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool_path.h"

#include <algorithm>
#include <limits>

#include "palpate/contact/signed_distance.h"
#include "sweep.h"

namespace palpate::tissue {
namespace {

// Factor of the margin after each exceeded search [-]; larger first margins cost more after a jump.
constexpr double kWider = 2.0;

// Resting obstacles are tested by distance too, since bounding balls of bones are loose.
bool mayReach(const contact::Obstacle& obstacle, const Vec3& low, const Vec3& high, double margin) {
  if (!sweepReaches(obstacle, low, high, margin)) return false;
  if (obstacle.owner.isInstrument()) return true;
  const Vec3 middle = obstacle.X_WG_end.inverse() * Vec3(0.5 * (low + high));
  return contact::signedDistanceValue(*obstacle.geometry, middle) <=
         0.5 * (high - low).norm() + margin + contact::distanceError(*obstacle.geometry);
}

}  // namespace

int ToolPath::begin(const std::vector<contact::Obstacle>& obstacles, const Points& x, double way) {
  // The estimate may be exceeded by pushed tissue; candidatesHold() detects that.
  margin_ = 0.02 * size_ + 2.0 * way;
  searched_ = false;
  const Vec3 low = x.rowwise().minCoeff(), high = x.rowwise().maxCoeff();
  near_.clear();
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    if (skip_far_ && !mayReach(obstacles[k], low, high, margin_ + contact_.reach())) continue;
    near_.push_back(obstacles[k]);
    near_.back().number = static_cast<int>(k);
  }
  placed_ = near_;
  return static_cast<int>(obstacles.size() - near_.size());
}

void ToolPath::clear() {
  near_.clear();
  placed_.clear();
  contact_.setObstacles(placed_);
  contact_.findCandidates(Points(), {});
}

void ToolPath::leaveOut(const std::vector<int>& numbers) {
  if (numbers.empty()) return;
  near_.erase(std::remove_if(near_.begin(), near_.end(),
                             [&](const contact::Obstacle& obstacle) {
                               return std::binary_search(numbers.begin(), numbers.end(),
                                                         obstacle.number);
                             }),
              near_.end());
  placed_ = near_;
}

void ToolPath::search(const Points& x) {
  if (searched_) margin_ *= kWider;
  searched_ = true;
  reach_.clear();
  ways_.clear();
  for (const contact::Obstacle& obstacle : near_) {
    const double way =
        contact::sweepLength(*obstacle.geometry, obstacle.X_WG_begin, obstacle.X_WG_end);
    ways_.push_back(way);
    reach_.push_back(margin_ + way + contact_.reach());
  }
  contact_.findCandidates(x, reach_);
  searched_at_ = x;
}

void ToolPath::moveTo(double s) {
  for (std::size_t k = 0; k < near_.size(); ++k) {
    placed_[k].X_WG_end = contact::interpolate(near_[k].X_WG_begin, near_[k].X_WG_end, s);
  }
  contact_.setObstacles(placed_);
}

bool ToolPath::pushTo(double s, const Points& x, Points* push) {
  if (!contact_.hasCandidates()) return false;
  motions_.clear();
  for (std::size_t k = 0; k < near_.size(); ++k) {
    const Pose X_WG = contact::interpolate(near_[k].X_WG_begin, near_[k].X_WG_end, s);
    motions_.push_back(X_WG * placed_[k].X_WG_end.inverse());
  }
  push->setZero(3, x.cols());
  return contact_.addPush(x, motions_, push);
}

void ToolPath::beginStep(const Points& x) {
  for (contact::Obstacle& obstacle : placed_) obstacle.X_WG_begin = obstacle.X_WG_end;
  contact_.beginStep(x);
}

int ToolPath::find(int number) const {
  for (std::size_t k = 0; k < near_.size(); ++k) {
    if (near_[k].number == number) return static_cast<int>(k);
  }
  return -1;
}

double ToolPath::next(const Points& x, double s, double end) {
  if (!contact_.hasCandidates()) return end;
  contact_.allowedMotions(x, ways_, &allowed_);
  return std::min(end, nextSweepStage(near_, allowed_, s));
}

double ToolPath::leap(double size) const {
  double longest = 0.0;
  for (const contact::Obstacle& o : near_) {
    const double way = contact::sweepLength(*o.geometry, o.X_WG_begin, o.X_WG_end);
    longest = std::max(longest, way / std::min(size, contact::inscribedRadius(*o.geometry)));
  }
  return longest;
}

double ToolPath::longestWay() const {
  double longest = 0.0;
  for (const contact::Obstacle& o : near_) {
    longest = std::max(longest, contact::sweepLength(*o.geometry, o.X_WG_begin, o.X_WG_end));
  }
  return longest;
}

double ToolPath::thinnest() const {
  double least = std::numeric_limits<double>::infinity();
  for (const contact::Obstacle& obstacle : near_) {
    least = std::min(least, contact::inscribedRadius(*obstacle.geometry));
  }
  return least;
}

}  // namespace palpate::tissue
