// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/fem/energy_term.h"
#include "palpate/tissue/step_hooks.h"

namespace palpate::tissue {

struct ModelSettings;

/// A body, an organ or an island of one, as interactions see it.
struct InteractingBody {
  const std::string& organ;           ///< Name of the organ.
  const Points& X;                    ///< Rest positions, world, 3 x n [m].
  const Points& x;                    ///< Positions at the cycle's begin, world, 3 x n [m].
  const Eigen::Matrix3Xi& triangles;  ///< Surface, outward.
  Vec3 low, high;                     ///< Bounding box of x [m].
  double way;  ///< Estimated largest displacement of a point in the cycle [m].
};

/// Whether the bounding boxes of two bodies, each grown by `way` and reach/2 [m], overlap.
bool boxesOverlap(const InteractingBody& a, const InteractingBody& b, double reach);

/// Energy of an interaction: a function of the points of a, then of b, or of a alone, 3 x n [m],
/// invariant to rigid motion of all points. Holds no reference to a body.
class InteractionTerm : public fem::EnergyTerm, public StepHooks {
 public:
  /// Finds candidates while no point moves farther from x than `way` [m].
  virtual void search(const Points& x, double way) = 0;
  /// Takes over the state of `old`, a term of the same interaction between the same bodies before a
  /// mesh adaptation.
  virtual void goOnFrom(const InteractionTerm& /*old*/) {}
};

/// A kind of interaction between bodies. Bodies that may interact in a cycle are solved as a group.
class Interaction {
 public:
  virtual ~Interaction() = default;
  /// Whether two bodies, or one with itself (&a == &b), may interact in the cycle that begins.
  /// Conservative: may be true without an interaction, is never false with one. Called in each
  /// cycle.
  virtual bool possible(const InteractingBody& a, const InteractingBody& b) const = 0;
  virtual std::unique_ptr<InteractionTerm> make(const InteractingBody& a,
                                                const InteractingBody& b) const = 0;
};

struct InteractionEntry {
  std::string name;
  std::shared_ptr<const Interaction> (*make)(const ModelSettings&);
};

/// All interactions; each of them is active.
const std::vector<InteractionEntry>& interactions();

}  // namespace palpate::tissue
