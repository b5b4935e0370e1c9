// SPDX-License-Identifier: GPL-3.0-or-later
#include "anchors.h"

#include <algorithm>

namespace palpate::contact {
namespace {

bool anchorBefore(const Anchor& a, const Anchor& b) { return a.before(b); }

}  // namespace

const Anchor* Anchors::find(const Touch& touch) const {
  Anchor key;
  key.number = touch.number;
  key.sample = touch.sample;
  const auto found = std::lower_bound(anchors_.begin(), anchors_.end(), key, anchorBefore);
  return found != anchors_.end() && !key.before(*found) ? &*found : nullptr;
}

bool Anchors::hold(int number, int first, int last) const {
  Anchor key;
  key.number = number;
  key.sample = first;
  for (auto anchor = std::lower_bound(anchors_.begin(), anchors_.end(), key, anchorBefore);
       anchor != anchors_.end() && anchor->number == number && anchor->sample <= last; ++anchor) {
    if (anchor->bite == Bite::kHeld) return true;
  }
  return false;
}

void Anchors::take(const std::vector<Anchor>& anchors) {
  anchors_.assign(anchors.begin(), anchors.end());  // into the same memory
  std::sort(anchors_.begin(), anchors_.end(), anchorBefore);
}

// What has no sample is a point of the obstacle, which stays the same.
void Anchors::goOnFrom(const Anchors& old, const std::function<int(int)>& now) {
  anchors_.clear();
  for (Anchor anchor : old.anchors_) {
    if (anchor.sample >= 0) {
      anchor.sample = now(anchor.sample);
      if (anchor.sample < 0) continue;
    }
    anchors_.push_back(anchor);
  }
  std::sort(anchors_.begin(), anchors_.end(), anchorBefore);
}

void Anchors::save(StateWriter* to) const {
  to->put(static_cast<std::int64_t>(anchors_.size()));
  for (const Anchor& anchor : anchors_) {
    to->put(anchor.number);
    to->put(anchor.sample);
    to->put(anchor.pressing);
    to->put(anchor.rise);
    to->put(anchor.slides);
    to->put(anchor.bite);
    for (int k = 0; k < 3; ++k) to->put(anchor.stretch_G[k]);
  }
}

void Anchors::restore(StateReader* from) {
  std::vector<Anchor> anchors(
      static_cast<std::size_t>(from->count(2 * sizeof(int) + 3 * sizeof(double))));
  for (Anchor& anchor : anchors) {
    from->get(&anchor.number);
    from->get(&anchor.sample);
    from->get(&anchor.pressing);
    from->get(&anchor.rise);
    from->get(&anchor.slides);
    from->get(&anchor.bite);
    for (int k = 0; k < 3; ++k) from->get(&anchor.stretch_G[k]);
  }
  for (std::size_t i = 1; i < anchors.size(); ++i) {
    if (!anchors[i - 1].before(anchors[i])) StateReader::fail();
  }
  anchors_.swap(anchors);
}

}  // namespace palpate::contact
