// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/contact/response.h"
#include "palpate/contact/touch.h"

namespace palpate::contact {

/// A pressure at the nodes where an obstacle touches, linear between them, zero elsewhere: a sorted
/// list of nodes, for there are few.
class Multipliers {
 public:
  /// At the touch's sample [Pa], >= 0.
  double at(const Touch& touch) const;
  /// The largest [Pa].
  double largest() const { return largest_; }

  /// What a touch asks for.
  struct MultiplierTarget {
    double pressure;  ///< That there be [Pa];
    double weight;    ///< its stiffness [N/m], as much as which it counts.
    double inertia;   ///< Half of (weight / (weight + inertia))^2 of a change is taken over [N/m],
    double growth_fraction;  ///< and if it is a growth that part of this;
    double decay_fraction;   ///< and that part of the sum is lost.
  };
  using TargetOf = std::function<MultiplierTarget(const Touch&)>;
  /// Changes each node by the mean of what the touches around it ask for, not below zero; nodes
  /// that no touch is near to are zero again.
  void change(const std::vector<Touch>& touches, const TargetOf& target);

  void clear();
  /// Takes over those of another surface, `now` saying where its nodes are on this one.
  void goOnFrom(const Multipliers& old, const Response::SurfaceMap& now);
  void save(StateWriter* to) const;
  /// @throws std::invalid_argument as StateReader does; all is then as it was.
  void restore(StateReader* from);

 private:
  struct Node {
    int number, node;  // of the obstacle, of the surface
    double pressure;
    bool before(const Node& other) const {
      return number != other.number ? number < other.number : node < other.node;
    }
  };
  struct Share {
    Node at;
    std::size_t order;
    double weight;  // of which the others are multiples
    double change, inertia, growth_fraction, decay_fraction;
    void operator+=(const Share& other);
  };
  struct Triangle {
    bool known;
    int number;
    Eigen::Vector3i nodes;
    Vec3 pressures;  // of its nodes [Pa]
  };
  double atNode(int number, int node) const;
  void gather(const std::vector<Touch>& touches, const TargetOf& target);
  void put(std::vector<Node>* nodes);

  std::vector<Node> nodes_, next_;
  std::vector<Share> shares_;
  double largest_ = 0.0;
  mutable Triangle last_{false, 0, Eigen::Vector3i::Zero(), Vec3::Zero()};  // that was asked for
};

}  // namespace palpate::contact
