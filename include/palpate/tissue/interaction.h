// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/fem/energy_term.h"

namespace palpate::tissue {

struct ModelSettings;

/// A soft body, an organ or an unconnected part of one, as others meet it.
struct InteractingBody {
  const std::string& organ;           ///< Its name.
  const Points& X;                    ///< At rest in the world, 3 x n [m].
  const Points& x;                    ///< Where a cycle begins, likewise.
  const Eigen::Matrix3Xi& triangles;  ///< Its surface, outward.
  Vec3 low, high;                     ///< The box around x [m].
  double way;  ///< No point goes farther in the cycle [m], as far as is known.
};

/// Whether the boxes of two bodies, each grown by its way and half of `reach` [m], meet.
bool boxesOverlap(const InteractingBody& a, const InteractingBody& b, double reach);

/// What acts between two bodies, or within one: an energy of the points of a and then of b, or of a
/// alone, 3 x n [m], the same whatever moves all of them rigidly. It refers to no body.
class InteractionTerm : public fem::EnergyTerm {
 public:
  /// Finds what may act while no point goes farther from x than `way` [m].
  virtual void search(const Points& x, double way) = 0;
  /// Whether what the last search found is still all that may act at x.
  virtual bool holds(const Points& x) const = 0;

  // Of a term with a memory; the others do nothing.
  /// A step begins, or has ended, at x.
  virtual void beginStep(const Points& /*x*/) {}
  virtual void endStep(const Points& /*x*/) {}
  /// As new.
  virtual void forget() {}
  /// Takes over what `old` remembers, a term of the same interaction between the same bodies, of
  /// which one or both have another mesh now.
  virtual void goOnFrom(const InteractionTerm& /*old*/) {}
  /// All memory between steps.
  virtual void save(StateWriter* /*to*/) const {}
  /// @throws std::invalid_argument as StateReader does.
  virtual void restore(StateReader* /*from*/) {}
};

/// A way in which bodies act on each other. Bodies between which one may act in a cycle are solved
/// together.
class Interaction {
 public:
  virtual ~Interaction() = default;
  /// Whether it may act between two bodies in the cycle that begins, or, where both are the same
  /// one (&a == &b), within it. Asked in every cycle: quick, and never a false no.
  virtual bool possible(const InteractingBody& a, const InteractingBody& b) const = 0;
  virtual std::unique_ptr<InteractionTerm> make(const InteractingBody& a,
                                                const InteractingBody& b) const = 0;
};

struct InteractionEntry {
  std::string name;
  std::shared_ptr<const Interaction> (*make)(const ModelSettings&);
};

/// The interactions that there are. All of them act.
const std::vector<InteractionEntry>& interactions();

}  // namespace palpate::tissue
