// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighbour_search.h"

#include <algorithm>
#include <tuple>

namespace palpate::tissue {
namespace {

// Margin of a body's displacement, relative to its size [-]; as in ToolPath.
constexpr double kMargin = 0.02;

auto key(const InteractingPair& m) { return std::make_tuple(m.interaction, m.a, m.b); }

}  // namespace

// Updates positions, boxes and estimated displacements, by velocity or a tool's motion.
void NeighbourSearch::updateBodies(const std::vector<GroupBody>& bodies, double dt) {
  seen_.clear();
  for (const GroupBody& b : bodies) {
    const FemBody& body = b.body->body();
    const double own = 2.0 * dt * body.v.colwise().norm().maxCoeff();
    // With dt = 0 the tools are those of the last cycle, which may have left.
    const bool pushes = dt > 0.0 && body.tool_contact.possible();
    const double pushed = pushes ? body.tool_path.longestWay() : 0.0;
    seen_.push_back({*b.organ, body.mesh.points, body.x, body.triangles,
                     body.x.rowwise().minCoeff(), body.x.rowwise().maxCoeff(),
                     kMargin * body.size + own + pushed});
  }
}

void NeighbourSearch::find(const std::vector<GroupBody>& bodies, double dt,
                           std::vector<int>* apart) {
  apart->assign(bodies.size(), 0);
  if (interactions_.empty()) return;
  updateBodies(bodies, dt);
  for (const std::unique_ptr<InteractingPair>& m : pairs_) m->acts = false;
  for (std::size_t i = 0; i < interactions_.size(); ++i) {
    for (std::size_t a = 0; a < bodies.size(); ++a) {
      for (std::size_t b = a; b < bodies.size(); ++b) {
        if (!may_interact_(bodies[a], bodies[b])) continue;
        const bool asked = !always_ || a == b;
        if (asked && !interactions_[i]->possible(seen_[a], seen_[b])) {
          (*apart)[a] += a != b;
          continue;
        }
        InteractingPair& m = pairOf(i, a, b);
        takeBodies(bodies, &m);
        m.acts = true;
        m.way = std::max(seen_[a].way, seen_[b].way);
      }
    }
  }
  for (const std::unique_ptr<InteractingPair>& m : pairs_) {
    if (!m->acts) m->term.reset();
  }
}

// Returns the pair, or inserts a new one.
InteractingPair& NeighbourSearch::pairOf(std::size_t interaction, std::size_t a, std::size_t b) {
  const auto place =
      std::lower_bound(pairs_.begin(), pairs_.end(), std::make_tuple(interaction, a, b),
                       [](const std::unique_ptr<InteractingPair>& m, const auto& wanted) {
                         return key(*m) < wanted;
                       });
  if (place != pairs_.end() && key(**place) == std::make_tuple(interaction, a, b)) {
    return **place;
  }
  auto made = std::make_unique<InteractingPair>();
  made->interaction = interaction;
  made->a = a;
  made->b = b;
  return **pairs_.insert(place, std::move(made));
}

// Makes the pair's term. After a mesh adaptation the new term takes over the state of the old one.
void NeighbourSearch::takeBodies(const std::vector<GroupBody>& bodies, InteractingPair* m) {
  const std::uint64_t a = bodies[m->a].revision, b = bodies[m->b].revision;
  if (m->term && m->revision_a == a && m->revision_b == b) return;
  std::unique_ptr<InteractionTerm> term =
      interactions_[m->interaction]->make(seen_[m->a], seen_[m->b]);
  if (m->term) term->goOnFrom(*m->term);
  m->term = std::move(term);
  m->revision_a = a;
  m->revision_b = b;
}

void NeighbourSearch::forgetOf(const std::vector<char>& bodies) {
  for (const std::unique_ptr<InteractingPair>& m : pairs_) {
    if (bodies[m->a] || bodies[m->b]) m->term.reset();
  }
}

void NeighbourSearch::save(StateWriter* out) const {
  std::int64_t count = 0;
  for (const std::unique_ptr<InteractingPair>& m : pairs_) count += m->term != nullptr;
  out->put(count);
  for (const std::unique_ptr<InteractingPair>& m : pairs_) {
    if (!m->term) continue;
    for (const std::size_t number : {m->interaction, m->a, m->b}) {
      out->put(static_cast<std::int64_t>(number));
    }
    m->term->save(out);
  }
}

void NeighbourSearch::restore(const std::vector<GroupBody>& bodies, StateReader* in) {
  forget();
  updateBodies(bodies, 0.0);
  for (std::int64_t left = in->count(3 * sizeof(std::int64_t)); left > 0; --left) {
    const auto number = [&](std::size_t end) {
      std::int64_t value = 0;
      in->get(&value);
      if (value < 0 || value >= static_cast<std::int64_t>(end)) StateReader::fail();
      return static_cast<std::size_t>(value);
    };
    const std::size_t interaction = number(interactions_.size());
    const std::size_t a = number(bodies.size()), b = number(bodies.size());
    InteractingPair& m = pairOf(interaction, a, b);
    takeBodies(bodies, &m);
    m.term->restore(in);
  }
}

}  // namespace palpate::tissue
