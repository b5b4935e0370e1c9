// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "body_group.h"
#include "neighbour_search.h"

namespace palpate::tissue {

/// The groups of a cycle: bodies that meet, directly or by way of others, are solved together, the
/// others alone. A group lasts while the same bodies belong together, and the latest ones that are
/// not needed are kept: bodies that meet again and again find theirs.
class BodyGroups {
 public:
  /// Solves a cycle of `dt` [s] of all bodies, which have begun it.
  void step(const std::vector<GroupBody>& bodies, const NeighbourSearch& neighbours, double dt);

  /// All bodies are alone.
  void forget() {
    for (Group& group : groups_) group.lasts = false;
  }
  /// Bodies are alone that belonged together with a marked one; a mark for each body.
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
    bool lasts, in_use;  // since the last cycle; in this one
  };
  void findLeaders(std::size_t count, const NeighbourSearch& neighbours);
  Group& groupOf(const std::vector<GroupBody>& bodies);
  void takeInteractions(const NeighbourSearch& neighbours, Group* group);
  void dropOld();

  std::vector<Group> groups_;  // the latest last
  std::vector<std::size_t> leader_, members_;
  std::vector<char> interacts_;  // each body, in this cycle
  std::vector<MemberInteraction> interactions_;
};

}  // namespace palpate::tissue
