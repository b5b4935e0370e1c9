// SPDX-License-Identifier: GPL-3.0-or-later
#include "friction_keys.h"

#include <algorithm>

namespace palpate::scene {
namespace {

template <class Config>
bool has(const std::vector<Config>& all, const std::string& name) {
  return name.empty() || std::any_of(all.begin(), all.end(),
                                     [&](const Config& config) { return config.name == name; });
}

}  // namespace

void describe(keys::FieldVisitor& v, FrictionPairConfig& pair) {
  v.text({"organ", "", "Name of an organ; where left out, any."}, pair.organ);
  v.text({"instrument", "", "Name of an instrument; where left out, any."}, pair.instrument);
  v.text({"link", "", "One of its links; where left out, any."}, pair.link);
  v.text({"anatomy", "", "Name of a part of the anatomy, in the place of an instrument."},
         pair.anatomy);
  v.rule(pair.link.empty() || !pair.instrument.empty(), "link", "needs the key instrument");
  v.rule(pair.anatomy.empty() || pair.instrument.empty(), "anatomy",
         "cannot stand beside instrument");
  contact::describeFriction(v, pair);
}

void describe(keys::FieldVisitor& v, FrictionConfig& friction) {
  contact::describeFriction(v, friction);
  v.list({"pairs", "",
          "What has another friction. The one that names most holds, of two alike the later one."},
         friction.pairs, 0);
}

void checkFrictionPairs(keys::FieldVisitor& v, const Scene& scene) {
  const std::string text = "must name organs, instruments and anatomy of the scene";
  v.rule(true, "contact.friction.pairs", "contact.friction.pairs: they " + text);
  for (std::size_t k = 0; k < scene.contact.friction.pairs.size(); ++k) {
    const FrictionPairConfig& pair = scene.contact.friction.pairs[k];
    const bool known = has(scene.organs, pair.organ) && has(scene.instruments, pair.instrument) &&
                       has(scene.anatomy, pair.anatomy);
    if (known) continue;
    v.rule(false, "contact.friction.pairs[" + std::to_string(k) + "]", text);
  }
}

}  // namespace palpate::scene
