// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/surroundings.h"

#include <algorithm>

namespace palpate::tissue {
namespace {

// Indices in `nodes` of those of `selected` that are among them.
std::vector<int> placesOf(const std::vector<int>& selected, const std::vector<int>& nodes) {
  std::vector<int> places;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (std::binary_search(selected.begin(), selected.end(), nodes[i])) {
      places.push_back(static_cast<int>(i));
    }
  }
  return places;
}

template <class Item>
std::vector<Item> itemsOf(const std::vector<Item>& whole, const std::vector<int>& nodes) {
  std::vector<Item> part;
  for (const Item& item : whole) {
    std::vector<int> places = placesOf(item.nodes, nodes);
    if (places.empty()) continue;
    part.push_back(item);
    part.back().nodes = std::move(places);
  }
  return part;
}

}  // namespace

bool Surroundings::damps() const {
  return std::any_of(springs.begin(), springs.end(),
                     [](const SpringSupport& s) { return s.constants.damped(); });
}

bool Surroundings::resistsVolumes() const {
  return std::any_of(pressures.begin(), pressures.end(),
                     [](const PressedFaces& p) { return p.content.volume_stiffness > 0.0; });
}

Surroundings partOf(const Surroundings& whole, const std::vector<int>& nodes) {
  Surroundings part;
  part.free.resize(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    part.free.col(static_cast<Eigen::Index>(i)) = whole.free.col(nodes[i]);
  }
  part.carried = itemsOf(whole.carried, nodes);
  part.springs = itemsOf(whole.springs, nodes);
  part.pressures = itemsOf(whole.pressures, nodes);
  return part;
}

}  // namespace palpate::tissue
