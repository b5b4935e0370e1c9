// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>

#include "urdf_outline.h"

namespace palpate::instrument {
namespace {

std::string quoted(const std::string& name) { return "'" + name + "'"; }

std::string didYouMean(const std::string& name, const std::vector<std::string>& known) {
  const std::string nearest = nearestName(name, known);
  return nearest.empty() ? "" : "; did you mean " + quoted(nearest) + "?";
}

/// Maps each link to its parent joint. Checks the links' names, and that no link has two parents.
std::map<std::string, const JointOutline*> joinLinks(UrdfOutline* outline) {
  std::map<std::string, const JointOutline*> above;
  const auto& links = outline->links;
  for (const JointOutline& joint : outline->joints) {
    if (outline->problems.size() >= kMaxProblems) break;
    for (const std::string* link : {&joint.parent, &joint.child}) {
      if (link->empty() || std::find(links.begin(), links.end(), *link) != links.end()) continue;
      outline->problems.push_back({joint.where + (link == &joint.parent ? " parent" : " child"),
                                   quoted(*link),
                                   "no link has this name" + didYouMean(*link, links)});
    }
    if (joint.child.empty()) continue;
    const auto [at, is_first] = above.emplace(joint.child, &joint);
    if (!is_first) {
      outline->problems.push_back({joint.where + " child", quoted(joint.child),
                                   "closes a joint loop: this link hangs on joint " +
                                       quoted(at->second->name) +
                                       " already, and a URDF must be a tree"});
    }
  }
  return above;
}

void checkTree(UrdfOutline* outline) {
  const std::size_t before = outline->problems.size();
  const auto above = joinLinks(outline);
  if (outline->problems.size() > before) return;  // later checks would repeat these problems
  std::vector<std::string> roots;
  for (const std::string& link : outline->links) {
    if (above.count(link) == 0) roots.push_back(link);
  }
  if (outline->links.empty()) {
    outline->problems.push_back({"robot " + outline->robot, "", "has no links"});
  } else if (roots.size() > 1) {
    outline->problems.push_back({"robot " + outline->robot, joinNames(roots),
                                 "these links hang on no joint; exactly one link may, the root"});
  }
  // Each link has at most one parent, so a link without path to a root is in a loop.
  for (const std::string& link : outline->links) {
    std::string at = link;
    std::string way = link;
    for (std::size_t steps = 0; above.count(at) != 0; ++steps) {
      at = above.at(at)->parent;
      way += " <- " + at;
      if (at != link && steps < outline->links.size()) continue;
      if (at == link) {
        outline->problems.push_back({above.at(link)->where, way,
                                     "is a joint loop; a URDF must be "
                                     "a tree with one root"});
        return;
      }
      break;
    }
  }
}

void checkMimics(UrdfOutline* outline) {
  std::map<std::string, const JointOutline*> joints;
  std::vector<std::string> names;
  for (const JointOutline& joint : outline->joints) {
    joints[joint.name] = &joint;
    names.push_back(joint.name);
  }
  for (const JointOutline& joint : outline->joints) {
    if (!joint.mimics || joint.type == "fixed") continue;
    if (outline->problems.size() >= kMaxProblems) break;
    const std::string where = joint.where + " mimic";
    const auto leader = joints.find(joint.mimic);
    if (leader == joints.end()) {
      outline->problems.push_back(
          {where, quoted(joint.mimic), "no joint has this name" + didYouMean(joint.mimic, names)});
    } else if (leader->second->type == "fixed") {
      outline->problems.push_back({where, quoted(joint.mimic),
                                   "is fixed; must be a joint that "
                                   "moves"});
    } else {
      std::string way = joint.name;
      const JointOutline* at = &joint;
      for (std::size_t steps = 0; at != nullptr && at->mimics && steps <= joints.size(); ++steps) {
        const auto next = joints.find(at->mimic);
        at = next == joints.end() ? nullptr : next->second;
        if (at != nullptr) way += " -> " + at->name;
        if (at != &joint) continue;
        outline->problems.push_back({where, way, "a joint must not follow itself"});
        break;
      }
    }
  }
}

}  // namespace

void checkTopology(UrdfOutline* outline) {
  if (outline->problems.size() >= kMaxProblems) return;  // the file was not read completely
  checkTree(outline);
  checkMimics(outline);
}

}  // namespace palpate::instrument
