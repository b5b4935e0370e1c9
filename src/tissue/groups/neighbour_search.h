// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "palpate/tissue/interaction.h"
#include "tissue/organ/fem_organ.h"

namespace palpate::tissue {

/// A body in the order of organ names, independent of the scene's order.
struct GroupBody {
  const std::string* organ;  ///< Name of the organ.
  int number;                ///< Index of the organ in the model.
  FemOrgan* body;
  std::uint64_t revision;  ///< SurfaceState::revision of the organ; a new one means a new body.
};

/// A pair of bodies, or a body with itself, with the energy of an interaction.
struct InteractingPair {
  std::size_t interaction, a, b;  ///< Indices of interaction and bodies, a <= b.
  std::unique_ptr<InteractionTerm> term;
  std::uint64_t revision_a = 0,
                revision_b = 0;  ///< Revisions of the bodies for which `term` was made.
  double way = 0.0;              ///< Argument of InteractionTerm::search() [m].
  bool acts = false;             ///< Whether the pair may interact in this cycle.
};

/// Neighbour search: finds the pairs of bodies that may interact in a cycle, with their energy
/// terms. A term persists over cycles while the pair may interact.
class NeighbourSearch {
 public:
  /// `may_interact(a, b)`: whether two bodies are allowed to interact; `always`: treat all allowed
  /// pairs as neighbours in every cycle.
  NeighbourSearch(std::vector<std::shared_ptr<const Interaction>> interactions,
                  std::function<bool(const GroupBody&, const GroupBody&)> may_interact, bool always)
      : interactions_(std::move(interactions)),
        may_interact_(std::move(may_interact)),
        always_(always) {}

  bool any() const { return !interactions_.empty(); }
  /// Finds the pairs of a cycle of `dt` [s]. `apart`: number of pairs without interaction, counted
  /// at the first body. @pre ToolContact::begin() of all bodies.
  void find(const std::vector<GroupBody>& bodies, double dt, std::vector<int>* apart);
  /// All pairs of the last find(), with those that do not interact.
  const std::vector<std::unique_ptr<InteractingPair>>& all() const { return pairs_; }

  /// Removes all pairs.
  void forget() { pairs_.clear(); }
  /// Resets the terms of pairs with a marked body; `bodies`: a mark per body.
  void forgetOf(const std::vector<char>& bodies);
  void save(StateWriter* out) const;
  void restore(const std::vector<GroupBody>& bodies, StateReader* in);

 private:
  InteractingPair& pairOf(std::size_t interaction, std::size_t a, std::size_t b);
  void takeBodies(const std::vector<GroupBody>& bodies, InteractingPair* pairOf);
  void updateBodies(const std::vector<GroupBody>& bodies, double dt);

  std::vector<std::shared_ptr<const Interaction>> interactions_;
  std::function<bool(const GroupBody&, const GroupBody&)> may_interact_;
  bool always_;
  std::vector<InteractingBody> seen_;
  std::vector<std::unique_ptr<InteractingPair>> pairs_;  // ascending
};

}  // namespace palpate::tissue
