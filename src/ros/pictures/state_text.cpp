// SPDX-License-Identifier: GPL-3.0-or-later
#include "state_text.h"

#include <iomanip>
#include <sstream>

#include "marker_parts.h"
#include "palpate/base/error.h"
#include "ros/messages/topics.h"

namespace palpate::node {
namespace {

using visualization_msgs::Marker;

std::string textOf(NodeState state, const std::vector<ToolState>& tools,
                   const std::vector<std::string>& names, const std::vector<std::string>& sources,
                   double coarsening) {
  if (state == NodeState::kWaiting) return "WAITING for " + joinNames(sources);
  if (state == NodeState::kPaused) return "PAUSED: no input";
  if (state == NodeState::kFault) return "FAULT: the solver fails, no force";
  std::string text;
  for (std::size_t i = 0; i < tools.size() && i < names.size(); ++i) {
    if (tools[i] != ToolState::kOutside) continue;
    text += (text.empty() ? "" : "\n") + names[i] + " is held outside: lift it out of the tissue";
  }
  if (coarsening == 1.0) return text;
  std::ostringstream factor;
  factor << std::setprecision(2) << coarsening;
  return text + (text.empty() ? "" : "\n") + "cycles are late: edges at tools are " + factor.str() +
         " times as long";
}

}  // namespace

StateText::StateText(const View& view, const std::vector<std::string>& names,
                     const std::vector<std::string>& sources)
    : names_(names),
      sources_(sources),
      marker_(node::marker(kStateMarkers, 0, Marker::TEXT_VIEW_FACING)) {
  const Vec3 middle = 0.5 * (view.box_min + view.box_max);
  marker_.pose.position.x = middle.x();
  marker_.pose.position.y = middle.y();
  marker_.pose.position.z = view.box_max.z() + 0.15 * view.size();
  marker_.scale.z = 0.05 * view.size();
}

bool StateText::update(NodeState state, const std::vector<ToolState>& tools, double coarsening) {
  const std::string text = textOf(state, tools, names_, sources_, coarsening);
  if (said_ && text == marker_.text) return false;
  said_ = true;
  marker_.text = text;
  marker_.action = text.empty() ? Marker::DELETE : Marker::ADD;
  marker_.color =
      state == NodeState::kFault ? colour(1.0F, 0.35F, 0.25F) : colour(1.0F, 0.80F, 0.30F);
  return true;
}

}  // namespace palpate::node
