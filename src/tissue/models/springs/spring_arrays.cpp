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
constexpr std::size_t kBatch = 8;

}  // namespace

SpringArrays::SpringArrays(const springs::SpringNetwork& network, Isa isa)
    : kernel_(springKernel(isa)) {
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
  size_ = static_cast<int>(a_.size());
  const std::size_t filled = (a_.size() + kBatch - 1) / kBatch * kBatch;
  for (std::vector<int>* of : {&a_, &b_}) of->resize(filled, 0);
  for (std::vector<double>* of : {&stiffness_, &preload_, &length_, &damping_}) of->resize(filled);
  for (const int end : a_) a3_.push_back(3 * end);
  for (const int end : b_) b3_.push_back(3 * end);
  force_.resize(static_cast<Eigen::Index>(filled), 3);
  energy_.resize(static_cast<Eigen::Index>(filled));
}

void SpringArrays::measure(const Points& x) const {
  kernel_({a3_.data(), b3_.data(), stiffness_.data(), preload_.data(), length_.data(),
           static_cast<int>(a3_.size())},
          x.data(), force_.data(), energy_.data());
}

double SpringArrays::energy(const Points& x) const {
  if (size_ == 0) return 0.0;
  measure(x);
  return energy_.sum();
}

// Springs of one first end follow one another: what they do to it is written once.
double SpringArrays::addGradient(const Points& x, Points* g) const {
  if (size_ == 0) return 0.0;
  measure(x);
  const double *fx = force_.col(0).data(), *fy = force_.col(1).data(), *fz = force_.col(2).data();
  const int *a = a3_.data(), *b = b3_.data();
  double* out = g->data();
  for (int s = 0; s < size_;) {
    double* from = out + a[s];
    double x0 = from[0], y0 = from[1], z0 = from[2];
    for (const int first = a[s]; s < size_ && a[s] == first; ++s) {
      double* to = out + b[s];
      x0 -= fx[s];
      y0 -= fy[s];
      z0 -= fz[s];
      to[0] += fx[s];
      to[1] += fy[s];
      to[2] += fz[s];
    }
    from[0] = x0;
    from[1] = y0;
    from[2] = z0;
  }
  return energy_.sum();
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
