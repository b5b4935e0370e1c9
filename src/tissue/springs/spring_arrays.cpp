// SPDX-License-Identifier: GPL-3.0-or-later
#include "spring_arrays.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace palpate::tissue {
namespace {

// Shorter springs have no direction [m^2].
constexpr double kNowhere = std::numeric_limits<double>::min();

}  // namespace

SpringArrays::SpringArrays(const springs::SpringNetwork& network) {
  std::vector<int> order(network.springs.size());
  std::iota(order.begin(), order.end(), 0);
  const auto ends = [&](int s) {
    const springs::Spring& spring = network.springs[static_cast<std::size_t>(s)];
    return std::make_tuple(std::min(spring.a, spring.b), std::max(spring.a, spring.b), s);
  };
  std::sort(order.begin(), order.end(), [&](int s, int t) { return ends(s) < ends(t); });
  for (const int s : order) {
    const springs::Spring& spring = network.springs[static_cast<std::size_t>(s)];
    a_.push_back(std::min(spring.a, spring.b));
    b_.push_back(std::max(spring.a, spring.b));
    stiffness_.push_back(spring.stiffness);
    preload_.push_back(spring.preload);
    length_.push_back(spring.length);
    damping_.push_back(spring.damping);
    damps_ = damps_ || spring.damping > 0.0;
  }
  way_.resize(3, size());
  distance_.resize(size());
  pull_.resize(size());
}

void SpringArrays::measure(const Points& x) const {
  const int count = size();
  for (int s = 0; s < count; ++s) way_.col(s) = x.col(b(s)) - x.col(a(s));
  const double* way = way_.data();
  double* distance = distance_.data();
  for (int s = 0; s < count; ++s) {
    const double square =
        way[3 * s] * way[3 * s] + way[3 * s + 1] * way[3 * s + 1] + way[3 * s + 2] * way[3 * s + 2];
    distance[s] = std::sqrt(square);
  }
}

double SpringArrays::energy(const Points& x) const {
  measure(x);
  double sum = 0.0;
  for (int s = 0; s < size(); ++s) sum += energy(s, distance_[s]);
  return sum;
}

double SpringArrays::addGradient(const Points& x, Points* g) const {
  measure(x);
  const int count = size();
  const double *distance = distance_.data(), *preload = preload_.data(),
               *stiffness = stiffness_.data(), *length = length_.data();
  double* pull = pull_.data();  // over the distance
  double sum = 0.0;
  for (int s = 0; s < count; ++s) {
    const double longer = distance[s] - length[s];
    pull[s] = (preload[s] + stiffness[s] * longer) / std::max(distance[s], kNowhere);
  }
  for (int s = 0; s < count; ++s) sum += energy(s, distance[s]);
  for (int s = 0; s < count; ++s) {
    const Vec3 force = pull[s] * way_.col(s);
    g->col(a(s)) -= force;
    g->col(b(s)) += force;
  }
  return sum;
}

void SpringArrays::addGradient(const Points& x, const std::vector<int>& some, Points* g) const {
  for (const int s : some) {
    const Vec3 way = x.col(b(s)) - x.col(a(s));
    const double distance = way.norm();
    const Vec3 pull = force(s, distance) / std::max(distance, kNowhere) * way;
    g->col(a(s)) -= pull;
    g->col(b(s)) += pull;
  }
}

void SpringArrays::addDamping(const Points& x, const Points& v, double ratio,
                              const std::vector<int>& some, Points* g) const {
  for (const int s : some) {
    const Vec3 way = x.col(b(s)) - x.col(a(s));
    const double square = way.squaredNorm();
    if (!(square > kNowhere)) continue;
    const double damping = damping_[static_cast<std::size_t>(s)] + ratio * stiffness(s);
    const Vec3 pull = damping * way.dot(v.col(b(s)) - v.col(a(s))) / square * way;
    g->col(a(s)) -= pull;
    g->col(b(s)) += pull;
  }
}

}  // namespace palpate::tissue
