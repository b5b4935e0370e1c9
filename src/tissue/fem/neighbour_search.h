// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fem_organ.h"
#include "palpate/tissue/interaction.h"

namespace palpate::tissue {

/// A body in the order of bodies, which does not depend on that of the scene: by organs' names.
struct GroupBody {
  const std::string* organ;  ///< Its name.
  int number;                ///< Of that organ, in the model.
  FemOrgan* body;
  std::uint64_t revision;  ///< Of its organ's shape: with another one the body is another.
};

/// An interaction between two bodies, or within one, while it may act.
struct InteractingPair {
  std::size_t interaction, a, b;  ///< a <= b: in the order of bodies.
  std::unique_ptr<InteractionTerm> term;
  std::uint64_t revision_a = 0, revision_b = 0;  ///< For which the term was made.
  double way = 0.0;                              ///< See InteractionTerm::search() [m].
  bool acts = false;                             ///< It may, in this cycle.
};

/// Which bodies may act on each other in a cycle, and what acts between them. A term lives on from
/// cycle to cycle, and forgets where it cannot act.
class NeighbourSearch {
 public:
  /// `may_interact(a, b)`: whether two bodies are let to act on each other at all. `always`: two
  /// are treated as if they could in every cycle.
  NeighbourSearch(std::vector<std::shared_ptr<const Interaction>> interactions,
                  std::function<bool(const GroupBody&, const GroupBody&)> may_interact, bool always)
      : interactions_(std::move(interactions)),
        may_interact_(std::move(may_interact)),
        always_(always) {}

  bool any() const { return !interactions_.empty(); }
  /// A cycle of `dt` [s] begins; the bodies' touches have been begun. Counts into `apart`, one a
  /// body, the pairs in which it is the first and that cannot act.
  void find(const std::vector<GroupBody>& bodies, double dt, std::vector<int>* apart);
  /// Of the last find(), with those that cannot act.
  const std::vector<std::unique_ptr<InteractingPair>>& all() const { return pairs_; }

  /// As new.
  void forget() { pairs_.clear(); }
  /// As new where one of the two bodies is marked; a mark for each body.
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
