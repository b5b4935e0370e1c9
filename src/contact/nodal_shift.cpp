// SPDX-License-Identifier: GPL-3.0-or-later
#include "nodal_shift.h"

#include <algorithm>
#include <cmath>

namespace palpate::contact {

double NodalShift::atNode(int number, int node) const {
  const Node key{number, node, 0.0};
  const auto found = std::lower_bound(nodes_.begin(), nodes_.end(), key,
                                      [](const Node& a, const Node& b) { return a.before(b); });
  return found != nodes_.end() && !key.before(*found) ? found->shift : 0.0;
}

// The shares of each node, added up; they follow one another by obstacle and node.
void NodalShift::gather(const std::vector<Touch>& touches, const WishOf& wish) {
  shares_.clear();
  for (const Touch& touch : touches) {
    const Wish w = wish(touch);
    for (int k = 0; k < 3; ++k) {
      const double weight = touch.weights[k] * w.stiffness;
      if (weight == 0.0) continue;
      const Node at{touch.number, touch.nodes[k], 0.0};
      shares_.push_back({at, shares_.size(), weight, weight * w.change, weight * w.inertia});
    }
  }
  // Within a node in the order of the touches, which is fixed.
  std::sort(shares_.begin(), shares_.end(), [](const Share& a, const Share& b) {
    return a.at.before(b.at) || (!b.at.before(a.at) && a.order < b.order);
  });
  std::size_t count = 0;
  for (const Share& share : shares_) {
    if (count == 0 || shares_[count - 1].at.before(share.at)) {
      shares_[count++] = share;
      continue;
    }
    Share& sum = shares_[count - 1];
    sum.weight += share.weight;
    sum.change += share.change;
    sum.inertia += share.inertia;
  }
  shares_.resize(count);
}

void NodalShift::change(const std::vector<Touch>& touches, const WishOf& wish) {
  gather(touches, wish);
  next_.clear();
  for (const Share& share : shares_) {
    const double part = share.weight / (share.weight + share.inertia / share.weight);
    Node node = share.at;
    node.shift = atNode(node.number, node.node) + part * share.change / share.weight;
    if (node.shift > 0.0) next_.push_back(node);
  }
  nodes_.swap(next_);
  findLargest();
}

double NodalShift::largestChange(const std::vector<Touch>& touches, const WishOf& wish) {
  gather(touches, wish);
  double largest = 0.0;
  for (const Share& share : shares_) {
    largest = std::max(largest, std::abs(share.change / share.weight));
  }
  return largest;
}

void NodalShift::findLargest() {
  largest_ = 0.0;
  for (const Node& node : nodes_) largest_ = std::max(largest_, node.shift);
}

void NodalShift::clear() {
  nodes_.clear();
  largest_ = 0.0;
}

void NodalShift::goOnFrom(const NodalShift& old, const std::function<int(int)>& now) {
  nodes_.clear();
  for (const Node& node : old.nodes_) {
    const int i = now(node.node);
    if (i >= 0) nodes_.push_back({node.number, i, node.shift});
  }
  std::sort(nodes_.begin(), nodes_.end(), [](const Node& a, const Node& b) { return a.before(b); });
  findLargest();
}

void NodalShift::save(StateWriter* to) const {
  to->put(static_cast<std::int64_t>(nodes_.size()));
  for (const Node& node : nodes_) {
    to->put(node.number);
    to->put(node.node);
    to->put(node.shift);
  }
}

void NodalShift::restore(StateReader* from) {
  std::vector<Node> nodes(static_cast<std::size_t>(from->count(2 * sizeof(int) + sizeof(double))));
  for (Node& node : nodes) {
    from->get(&node.number);
    from->get(&node.node);
    from->get(&node.shift);
  }
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    if (!nodes[i - 1].before(nodes[i])) StateReader::fail();
  }
  nodes_.swap(nodes);
  findLargest();
}

}  // namespace palpate::contact
