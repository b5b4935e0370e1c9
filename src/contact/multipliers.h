// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/contact/response.h"
#include "palpate/contact/touch.h"

namespace palpate::contact {

/// Contact multipliers of the augmented Lagrangian: pressures at touched nodes of each obstacle
/// [Pa], linear on triangles, zero elsewhere. A sorted list of nodes.
class Multipliers {
 public:
  /// Multiplier at the touch's sample [Pa], >= 0.
  double at(const Touch& touch) const;
  /// Largest nodal multiplier [Pa].
  double largest() const { return largest_; }

  /// Target of the multipliers around a touch.
  struct MultiplierTarget {
    double pressure;  ///< Target pressure [Pa].
    double weight;    ///< Weight of the touch: contact stiffness [N/m].
    double inertia;   ///< Mass over squared step [N/m]: a change is scaled by (weight / (weight +
                      ///< inertia))^2 / 2.
    double growth_fraction;  ///< Further factor of an increase [-].
    double decay_fraction;   ///< Fraction by which the new multiplier decays [-].
  };
  using TargetOf = std::function<MultiplierTarget(const Touch&)>;
  /// Updates each node by the weighted mean of the targets around it, >= 0; nodes without a touch
  /// become zero.
  void change(const std::vector<Touch>& touches, const TargetOf& target);

  void clear();
  /// Takes over the multipliers of another surface by its map `now`.
  void goOnFrom(const Multipliers& old, const Response::SurfaceMap& now);
  void save(StateWriter* to) const;
  /// @throws std::invalid_argument as StateReader; the multipliers are then unchanged.
  void restore(StateReader* from);

 private:
  struct Node {
    int number, node;  // Obstacle::number, node of the surface
    double pressure;
    bool before(const Node& other) const {
      return number != other.number ? number < other.number : node < other.node;
    }
  };
  struct Share {
    Node at;
    std::size_t order;
    double weight;  // factor in the members below
    double change, inertia, growth_fraction, decay_fraction;
    void operator+=(const Share& other);
  };
  struct Triangle {
    bool known;
    int number;
    Eigen::Vector3i nodes;
    Vec3 pressures;  // at its nodes [Pa]
  };
  double atNode(int number, int node) const;
  void gather(const std::vector<Touch>& touches, const TargetOf& target);
  void put(std::vector<Node>* nodes);

  std::vector<Node> nodes_, next_;
  std::vector<Share> shares_;
  double largest_ = 0.0;
  mutable Triangle last_{false, 0, Eigen::Vector3i::Zero(), Vec3::Zero()};  // of the last at()
};

}  // namespace palpate::contact
