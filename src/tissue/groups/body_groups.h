// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "body_group.h"
#include "neighbour_search.h"

namespace palpate::tissue {

/// Groups of a cycle: connected components of interacting bodies are solved as one, others alone.
/// A group lasts while its members stay the same. The latest unused groups are kept for reuse.
class BodyGroups {
 public:
  /// Solves a cycle of `dt` [s] of all bodies.
  /// @pre All bodies have begun the cycle.
  void step(const std::vector<GroupBody>& bodies, const NeighbourSearch& neighbours, double dt);

  /// Ends all groups.
  void forget() {
    for (Group& group : groups_) group.lasts = false;
  }
  /// Ends the groups with a marked body; `bodies`: a mark per body.
  void forgetOf(const std::vector<char>& bodies) {
    for (Group& group : groups_) {
      for (const std::size_t k : group.bodies) group.lasts = group.lasts && !bodies[k];
    }
  }
  void save(StateWriter* out) const;
  void restore(const std::vector<GroupBody>& bodies, StateReader* in);

 private:
  struct Group {
    std::vector<std::size_t> bodies;
    std::vector<std::uint64_t> revisions;  // of each
    std::unique_ptr<BodyGroup> solved;
    bool lasts, in_use;  // in the last cycle; in this one
  };
  void findLeaders(std::size_t count, const NeighbourSearch& neighbours);
  Group& groupOf(const std::vector<GroupBody>& bodies);
  void takeInteractions(const NeighbourSearch& neighbours, Group* group);
  void dropOld();

  std::vector<Group> groups_;  // the most recent last
  std::vector<std::size_t> leader_, members_;
  std::vector<char> interacts_;  // of each body, in this cycle
  std::vector<MemberInteraction> interactions_;
};

}  // namespace palpate::tissue
