// SPDX-License-Identifier: GPL-3.0-or-later
#include "body_groups.h"

#include <algorithm>

namespace palpate::tissue {
namespace {

constexpr std::ptrdiff_t kMostKept = 4;  // unused groups

}  // namespace

// Finds connected components; the leader of a component is its first body.
void BodyGroups::findLeaders(std::size_t count, const NeighbourSearch& neighbours) {
  leader_.resize(count);
  for (std::size_t k = 0; k < count; ++k) leader_[k] = k;
  interacts_.assign(count, 0);
  for (const std::unique_ptr<InteractingPair>& m : neighbours.all()) {
    if (!m->acts) continue;
    interacts_[m->a] = interacts_[m->b] = 1;
    const std::size_t first = std::min(leader_[m->a], leader_[m->b]);
    const std::size_t other = std::max(leader_[m->a], leader_[m->b]);
    std::replace(leader_.begin(), leader_.end(), other, first);
  }
}

void BodyGroups::step(const std::vector<GroupBody>& bodies, const NeighbourSearch& neighbours,
                      double dt) {
  findLeaders(bodies.size(), neighbours);
  for (Group& group : groups_) group.in_use = false;
  for (std::size_t first = 0; first < bodies.size(); ++first) {
    if (interacts_[first] == 0) {
      bodies[first].body->stepAlone(dt);
      continue;
    }
    if (leader_[first] != first) continue;
    members_.clear();
    for (std::size_t k = first; k < bodies.size(); ++k) {
      if (leader_[k] == first) members_.push_back(k);
    }
    Group& group = groupOf(bodies);
    if (!group.lasts) group.solved->join();
    group.in_use = true;
    takeInteractions(neighbours, &group);
    group.solved->step(dt);
  }
  for (Group& group : groups_) group.lasts = group.in_use;
  dropOld();
}

// Returns the group of members_, or makes it.
BodyGroups::Group& BodyGroups::groupOf(const std::vector<GroupBody>& bodies) {
  const auto same = [&](const Group& group) { return group.bodies == members_; };
  auto found = std::find_if(groups_.begin(), groups_.end(), same);
  if (found != groups_.end()) {
    // A mesh adaptation of a member needs a new group.
    bool current = true;
    for (std::size_t k = 0; k < members_.size(); ++k) {
      current = current && found->revisions[k] == bodies[members_[k]].revision;
    }
    if (current) return *found;
    groups_.erase(found);
  }
  std::vector<FemOrgan*> organs;
  std::vector<std::uint64_t> revisions;
  for (const std::size_t k : members_) {
    organs.push_back(bodies[k].body);
    revisions.push_back(bodies[k].revision);
  }
  groups_.push_back({members_, std::move(revisions), std::make_unique<BodyGroup>(std::move(organs)),
                     false, false});
  return groups_.back();
}

void BodyGroups::takeInteractions(const NeighbourSearch& neighbours, Group* group) {
  interactions_.clear();
  const auto number = [&](std::size_t body) {
    const auto at = std::find(group->bodies.begin(), group->bodies.end(), body);
    return static_cast<std::size_t>(at - group->bodies.begin());
  };
  for (const std::unique_ptr<InteractingPair>& m : neighbours.all()) {
    if (!m->acts || leader_[m->a] != group->bodies.front()) continue;
    interactions_.push_back({m->term.get(), number(m->a), number(m->b), m->way});
  }
  group->solved->setInteractions(interactions_);
}

void BodyGroups::dropOld() {
  std::ptrdiff_t kept = std::count_if(groups_.begin(), groups_.end(),
                                      [](const Group& group) { return !group.lasts; });
  for (auto group = groups_.begin(); kept > kMostKept;) {
    if (group->lasts) {
      ++group;
    } else {
      group = groups_.erase(group);
      --kept;
    }
  }
}

void BodyGroups::save(StateWriter* out) const {
  std::int64_t count = 0;
  for (const Group& group : groups_) count += group.lasts;
  out->put(count);
  for (const Group& group : groups_) {
    if (!group.lasts) continue;
    out->put(static_cast<std::int64_t>(group.bodies.size()));
    for (const std::size_t body : group.bodies) out->put(static_cast<std::int64_t>(body));
    group.solved->save(out);
  }
}

void BodyGroups::restore(const std::vector<GroupBody>& bodies, StateReader* in) {
  forget();
  for (std::int64_t left = in->count(sizeof(std::int64_t)); left > 0; --left) {
    members_.clear();
    for (std::int64_t size = in->count(sizeof(std::int64_t)); size > 0; --size) {
      std::int64_t body = 0;
      in->get(&body);
      const bool ascends = members_.empty() || body > static_cast<std::int64_t>(members_.back());
      if (body < 0 || body >= static_cast<std::int64_t>(bodies.size()) || !ascends) {
        StateReader::fail();
      }
      members_.push_back(static_cast<std::size_t>(body));
    }
    if (members_.empty()) StateReader::fail();
    Group& group = groupOf(bodies);
    group.solved->restore(in);
    group.lasts = true;
  }
}

}  // namespace palpate::tissue
