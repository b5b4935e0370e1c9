// SPDX-License-Identifier: GPL-3.0-or-later
#include "urdf_outline.h"

#include <algorithm>
#include <cstring>
#include <set>

#include "element_checks.h"

namespace palpate::instrument {
namespace {

using Element = tinyxml2::XMLElement;

/// Far beyond any instrument; keeps the recursion of the libraries over links shallow.
constexpr std::size_t kMaxLinks = 1000;

std::string linkOf(const Element& joint, const char* side, std::vector<Problem>* problems) {
  const Element* element = joint.FirstChildElement(side);
  const std::string link = element == nullptr ? "" : text(*element, "link");
  if (link.empty()) {
    problems->push_back({whereIs(joint), "", std::string("needs <") + side + " link=\"...\"/>"});
  }
  return link;
}

void checkType(const Element& joint, std::vector<Problem>* problems) {
  static const std::vector<std::string> kSupported = {"revolute", "continuous", "prismatic",
                                                      "fixed"};
  const std::string type = text(joint, "type");
  if (std::find(kSupported.begin(), kSupported.end(), type) != kSupported.end()) return;
  const bool known = type == "planar" || type == "floating";
  const std::string nearest = nearestName(type, kSupported);
  problems->push_back({whereIs(joint, "type"), "'" + type + "'",
                       (known ? "is not supported; must be " : "must be ") +
                           std::string("one of ") + joinNames(kSupported) +
                           (nearest.empty() ? "" : "; did you mean " + nearest + "?")});
}

void readLink(const Element& link, std::set<std::string>* names, UrdfOutline* outline) {
  const std::string name = text(link, "name");
  if (name.empty()) {
    outline->problems.push_back({whereIs(link), "", "needs a name"});
  } else if (!names->insert(name).second) {
    outline->problems.push_back({whereIs(link), "", "a link of this name stands above"});
  }
  outline->links.push_back(name);
  outline->shapes.push_back(0);
  for (const char* kind : {"visual", "collision"}) {
    for (const Element* e = link.FirstChildElement(kind); e; e = e->NextSiblingElement(kind)) {
      ++outline->shapes.back();
      checkShape(*e, &outline->problems);
    }
  }
}

void readJoint(const Element& element, std::set<std::string>* names, UrdfOutline* outline) {
  JointOutline joint;
  joint.where = whereIs(element);
  joint.name = text(element, "name");
  joint.type = text(element, "type");
  if (joint.name.empty()) {
    outline->problems.push_back({joint.where, "", "needs a name"});
  } else if (!names->insert(joint.name).second) {
    outline->problems.push_back({joint.where, "", "a joint of this name stands above"});
  }
  checkType(element, &outline->problems);
  joint.parent = linkOf(element, "parent", &outline->problems);
  joint.child = linkOf(element, "child", &outline->problems);
  checkJointNumbers(element, &outline->problems);
  if (const Element* mimic = element.FirstChildElement("mimic")) {
    joint.mimics = true;
    joint.mimic = text(*mimic, "joint");
  }
  outline->joints.push_back(joint);
}

}  // namespace

UrdfOutline readOutline(const std::string& file, const std::string& text_of_file) {
  if (text_of_file.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw InputError(file, "", "", "is empty; must be a URDF");
  }
  tinyxml2::XMLDocument document;
  if (document.Parse(text_of_file.data(), text_of_file.size()) != tinyxml2::XML_SUCCESS) {
    throw InputError(file, "line " + std::to_string(document.ErrorLineNum()), "",
                     std::string("is not XML, or ends too early (") + document.ErrorName() + ")");
  }
  const Element* robot = document.RootElement();
  if (robot == nullptr || std::strcmp(robot->Name(), "robot") != 0) {
    throw InputError(file, "", robot == nullptr ? "" : std::string("<") + robot->Name() + ">",
                     "the root of a URDF must be <robot>");
  }
  UrdfOutline outline;
  outline.robot = text(*robot, "name");
  if (outline.robot.empty()) outline.problems.push_back({whereIs(*robot), "", "needs a name"});
  std::set<std::string> link_names, joint_names;
  for (const Element* e = robot->FirstChildElement(); e; e = e->NextSiblingElement()) {
    if (std::strcmp(e->Name(), "link") == 0) readLink(*e, &link_names, &outline);
    if (std::strcmp(e->Name(), "joint") == 0) readJoint(*e, &joint_names, &outline);
    if (std::strncmp(e->Name(), "xacro:", 6) == 0) {
      outline.problems.push_back({whereIs(*e), "", "is a macro; expand the file with xacro first"});
    }
  }
  if (outline.links.size() > kMaxLinks) {
    throw InputError(file, "", std::to_string(outline.links.size()) + " links",
                     "must be at most " + std::to_string(kMaxLinks));
  }
  return outline;
}

}  // namespace palpate::instrument
