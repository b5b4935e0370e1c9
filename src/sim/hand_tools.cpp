// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/sim/hand_tools.h"

namespace palpate::sim {

HandTools::HandTools(const Simulator& simulator) {
  const scene::Scene& scene = simulator.scene();
  for (std::size_t i = 0; i < scene.instruments.size(); ++i) {
    tools_.emplace_back(scene.instruments[i].proxy, scene.instruments[i].device,
                        1.0 / scene.rates.haptic);
    links_.push_back(static_cast<std::size_t>(simulator.controlLink(static_cast<int>(i))));
  }
}

void HandTools::target(std::vector<LinkPoses>* poses) {
  for (std::size_t i = 0; i < tools_.size(); ++i) {
    LinkPoses& links = (*poses)[i];
    if (links.empty()) continue;
    const Vec3 p_hand = links[links_[i]].translation(), way = tools_[i].target(p_hand) - p_hand;
    for (Pose& X : links) X.pretranslate(way);
  }
}

const haptics::RenderTarget& HandTools::observe(std::size_t i, bool held, const LinkPoses& target,
                                                const InstrumentResult& tool, double dt) {
  if (held && tool.live) {
    return tools_[i].observe(target[links_[i]].translation(), tool.X_WC.translation(), tool.solved,
                             dt);
  }
  return held && tool.there ? tools_[i].fade() : tools_[i].lose();
}

void HandTools::lose() {
  for (haptics::ToolRenderer& tool : tools_) tool.lose();
}

}  // namespace palpate::sim
