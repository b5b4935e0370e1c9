// SPDX-License-Identifier: GPL-3.0-or-later
#include "multipliers.h"

#include <algorithm>
#include <cmath>

namespace palpate::contact {
namespace {

// Fraction of a change that is applied [-]; 1 lets compressed elements oscillate.
constexpr double kUpdateFraction = 0.5;

}  // namespace

void Multipliers::Share::operator+=(const Share& other) {
  weight += other.weight;
  change += other.change;
  inertia += other.inertia;
  growth_fraction += other.growth_fraction;
  decay_fraction += other.decay_fraction;
}

// Consecutive samples share a triangle, so its nodal values are cached.
double Multipliers::at(const Touch& touch) const {
  double sum = 0.0;
  if (nodes_.empty()) return sum;
  if (!last_.known || last_.number != touch.number || last_.nodes != touch.nodes) {
    last_ = {true, touch.number, touch.nodes, Vec3::Zero()};
    for (int k = 0; k < 3; ++k) last_.pressures[k] = atNode(touch.number, touch.nodes[k]);
  }
  for (int k = 0; k < 3; ++k) {
    if (touch.weights[k] != 0.0) sum += touch.weights[k] * last_.pressures[k];
  }
  return sum;
}

double Multipliers::atNode(int number, int node) const {
  const Node key{number, node, 0.0};
  const auto found = std::lower_bound(nodes_.begin(), nodes_.end(), key,
                                      [](const Node& a, const Node& b) { return a.before(b); });
  return found != nodes_.end() && !key.before(*found) ? found->pressure : 0.0;
}

// Sums the contributions to each node, sorted by obstacle and node.
void Multipliers::gather(const std::vector<Touch>& touches, const TargetOf& target) {
  shares_.clear();
  for (const Touch& touch : touches) {
    const MultiplierTarget w = target(touch);
    const double change = w.pressure - at(touch);
    for (int k = 0; k < 3; ++k) {
      const double weight = touch.weights[k] * w.weight;
      if (weight == 0.0) continue;
      const Node node{touch.number, touch.nodes[k], 0.0};
      shares_.push_back({node, shares_.size(), weight, weight * change, weight * w.inertia,
                         weight * w.growth_fraction, weight * w.decay_fraction});
    }
  }
  // Contributions to a node are in the fixed order of the touches.
  std::sort(shares_.begin(), shares_.end(), [](const Share& a, const Share& b) {
    return a.at.before(b.at) || (!b.at.before(a.at) && a.order < b.order);
  });
  std::size_t count = 0;
  for (const Share& share : shares_) {
    if (count == 0 || shares_[count - 1].at.before(share.at)) {
      shares_[count++] = share;
    } else {
      shares_[count - 1] += share;
    }
  }
  shares_.resize(count);
}

void Multipliers::change(const std::vector<Touch>& touches, const TargetOf& target) {
  gather(touches, target);
  next_.clear();
  for (const Share& share : shares_) {
    const double borne = share.weight / (share.weight + share.inertia / share.weight);
    double part = kUpdateFraction * borne * borne;
    if (share.change > 0.0) part *= share.growth_fraction / share.weight;
    Node node = share.at;
    node.pressure = atNode(node.number, node.node) + part * share.change / share.weight;
    node.pressure *= 1.0 - share.decay_fraction / share.weight;
    if (node.pressure > 0.0) next_.push_back(node);
  }
  put(&next_);
}

// Swaps the sorted nodes with the present ones.
void Multipliers::put(std::vector<Node>* nodes) {
  nodes_.swap(*nodes);
  last_.known = false;
  largest_ = 0.0;
  for (const Node& node : nodes_) largest_ = std::max(largest_, node.pressure);
}

void Multipliers::clear() {
  nodes_.clear();
  last_.known = false;
  largest_ = 0.0;
}

void Multipliers::goOnFrom(const Multipliers& old, const Response::SurfaceMap& now) {
  std::vector<int> numbers;  // of obstacles, ascending
  for (const Node& node : old.nodes_) {
    if (numbers.empty() || numbers.back() != node.number) numbers.push_back(node.number);
  }
  next_.clear();
  for (int number : numbers) {
    for (const Response::SurfaceMap::Node& place : now.nodes) {
      Node node{number, place.node, 0.0};
      for (int k = 0; k < 3; ++k) {
        node.pressure += place.weights[k] * old.atNode(number, place.old[k]);
      }
      if (node.pressure > 0.0) next_.push_back(node);
    }
  }
  put(&next_);
}

void Multipliers::save(StateWriter* to) const {
  to->put(static_cast<std::int64_t>(nodes_.size()));
  for (const Node& node : nodes_) {
    to->put(node.number);
    to->put(node.node);
    to->put(node.pressure);
  }
}

void Multipliers::restore(StateReader* from) {
  next_.resize(static_cast<std::size_t>(from->count(2 * sizeof(int) + sizeof(double))));
  for (Node& node : next_) {
    from->get(&node.number);
    from->get(&node.node);
    from->get(&node.pressure);
  }
  for (std::size_t i = 1; i < next_.size(); ++i) {
    if (!next_[i - 1].before(next_[i])) StateReader::fail();
  }
  put(&next_);
}

}  // namespace palpate::contact
