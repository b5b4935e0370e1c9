// SPDX-License-Identifier: GPL-3.0-or-later
#include "plain_lbfgs.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>
#include <vector>

namespace palpate::enrichment {
namespace {

constexpr std::size_t kPairs = 20;
constexpr double kArmijo = 1e-4;
constexpr int kMaxHalvings = 40;

struct Pair {
  Eigen::VectorXd s, y;
  double sy;
};

Eigen::VectorXd direction(const std::deque<Pair>& pairs, const Eigen::VectorXd& gradient) {
  Eigen::VectorXd d = -gradient;
  std::vector<double> alpha(pairs.size());
  for (std::size_t k = pairs.size(); k-- > 0;) {
    alpha[k] = pairs[k].s.dot(d) / pairs[k].sy;
    d -= alpha[k] * pairs[k].y;
  }
  if (!pairs.empty()) d *= pairs.back().sy / pairs.back().y.squaredNorm();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    d += (alpha[k] - pairs[k].y.dot(d) / pairs[k].sy) * pairs[k].s;
  }
  return d;
}

}  // namespace

double minimizeByLbfgs(const SmoothFunction& function, int max_iterations, Eigen::VectorXd* x,
                       const std::function<void(int, double)>& each) {
  Eigen::VectorXd g, g_trial, x_trial;
  double value = function(*x, &g);
  std::deque<Pair> pairs;
  for (int k = 0; k < max_iterations; ++k) {
    if (each) each(k, value);
    Eigen::VectorXd d = direction(pairs, g);
    if (!(d.dot(g) < 0.0)) {
      pairs.clear();
      d = -g;
    }
    const double slope = d.dot(g);
    double step = pairs.empty() ? 1.0 / std::max(1.0, g.norm()) : 1.0, trial = 0.0;
    bool found = false;
    for (int h = 0; h < kMaxHalvings && !found; ++h, step *= found ? 1.0 : 0.5) {
      x_trial = *x + step * d;
      trial = function(x_trial, &g_trial);
      found = trial < value && trial <= value + kArmijo * step * slope;
    }
    if (!found) {
      if (pairs.empty()) break;
      pairs.clear();
      continue;
    }
    Pair pair{x_trial - *x, g_trial - g, 0.0};
    pair.sy = pair.s.dot(pair.y);
    if (pair.sy > 1e-12 * pair.y.squaredNorm()) pairs.push_back(std::move(pair));
    if (pairs.size() > kPairs) pairs.pop_front();
    *x = x_trial;
    g = g_trial;
    value = trial;
  }
  return value;
}

}  // namespace palpate::enrichment
