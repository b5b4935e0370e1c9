// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/contact/touch.h"

namespace palpate::contact {

/// A length at the nodes where an obstacle touches, linear between them, zero elsewhere: a sorted
/// list of nodes, for there are few.
class NodalShift {
 public:
  /// At the touch's sample [m].
  double at(const Touch& touch) const {
    double sum = 0.0;
    if (nodes_.empty()) return sum;
    for (int k = 0; k < 3; ++k) {
      if (touch.weights[k] != 0.0) sum += touch.weights[k] * atNode(touch.number, touch.nodes[k]);
    }
    return sum;
  }
  /// The largest [m].
  double largest() const { return largest_; }

  /// What a touch asks for: a change [m] of the shift at its sample, which counts as much as its
  /// stiffness, and of which the part stiffness / (stiffness + inertia) is taken over.
  struct Wish {
    double change, stiffness, inertia;  ///< [m], [N/m], [N/m]
  };
  using WishOf = std::function<Wish(const Touch&)>;
  /// Changes each node by the mean of what the touches around it ask for, not below zero; nodes
  /// that no touch is near to are zero again.
  void change(const std::vector<Touch>& touches, const WishOf& wish);
  /// The most that this would change a node that is touched [m], inertia left aside.
  double largestChange(const std::vector<Touch>& touches, const WishOf& wish);

  void clear();
  /// Takes over the shift of another surface's nodes, `now(i)` being node i in this one, or -1.
  void goOnFrom(const NodalShift& old, const std::function<int(int)>& now);
  void save(StateWriter* to) const;
  /// @throws std::invalid_argument as StateReader does; the shift is then as it was.
  void restore(StateReader* from);

 private:
  struct Node {
    int number, node;  // of the obstacle, of the surface
    double shift;
    bool before(const Node& other) const {
      return number != other.number ? number < other.number : node < other.node;
    }
  };
  struct Share {
    Node at;
    std::size_t order;
    double weight, change, inertia;  // the two last times the weight
  };
  double atNode(int number, int node) const;
  void gather(const std::vector<Touch>& touches, const WishOf& wish);
  void findLargest();

  std::vector<Node> nodes_, next_;
  std::vector<Share> shares_;
  double largest_ = 0.0;
};

}  // namespace palpate::contact
