// SPDX-License-Identifier: GPL-3.0-or-later
#include "urdf_outline.h"

#include <algorithm>
#include <cstring>
#include <set>

#include "element_checks.h"

namespace palpate::instrument {
namespace {

using Element = tinyxml2::XMLElement;

/// Limits beyond any instrument. They bound recursion over links and quadratic algorithms.
constexpr std::size_t kMaxLinks = 1000, kMaxShapes = 10000, kMaxName = 100;

/// Collects links, joints and their problems.
class Outliner {
 public:
  explicit Outliner(UrdfOutline* outline) : outline_(outline) {}

  void readLink(const Element& link);
  void readJoint(const Element& element);
  /// Whether the limit of problems, links, joints or shapes is reached.
  bool full() const {
    return outline_->problems.size() >= kMaxProblems || outline_->links.size() > kMaxLinks ||
           outline_->joints.size() > kMaxLinks || num_shapes_ > kMaxShapes;
  }
  /// @throws InputError for counts beyond the limits.
  void checkCounts(const std::string& file) const;

 private:
  void checkName(const std::string& name, const std::string& where, const char* kind,
                 std::set<std::string>* names);

  UrdfOutline* outline_;
  std::set<std::string> link_names_, joint_names_;
  std::size_t num_shapes_ = 0;
};

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

void Outliner::checkName(const std::string& name, const std::string& where, const char* kind,
                         std::set<std::string>* names) {
  if (name.empty()) {
    outline_->problems.push_back({where, "", "needs a name"});
  } else if (name.size() > kMaxName) {
    outline_->problems.push_back(
        {where, "", "must have a name of at most " + std::to_string(kMaxName) + " bytes"});
  } else if (!names->insert(name).second) {
    outline_->problems.push_back(
        {where, "", std::string("a ") + kind + " of this name stands above"});
  }
}

void Outliner::readLink(const Element& link) {
  checkName(text(link, "name"), whereIs(link), "link", &link_names_);
  outline_->links.push_back(text(link, "name"));
  outline_->shapes.push_back(0);
  for (const char* kind : {"visual", "collision"}) {
    for (const Element* e = link.FirstChildElement(kind); e && !full();
         e = e->NextSiblingElement(kind)) {
      ++num_shapes_;
      ++outline_->shapes.back();
      checkShape(*e, &outline_->problems);
    }
  }
}

void Outliner::readJoint(const Element& element) {
  JointOutline joint;
  joint.where = whereIs(element);
  joint.name = text(element, "name");
  joint.type = text(element, "type");
  checkName(joint.name, joint.where, "joint", &joint_names_);
  checkType(element, &outline_->problems);
  joint.parent = linkOf(element, "parent", &outline_->problems);
  joint.child = linkOf(element, "child", &outline_->problems);
  checkJointNumbers(element, &outline_->problems);
  if (const Element* mimic = element.FirstChildElement("mimic")) {
    joint.mimics = true;
    joint.mimic = text(*mimic, "joint");
  }
  outline_->joints.push_back(joint);
}

void Outliner::checkCounts(const std::string& file) const {
  const auto check = [&](std::size_t count, std::size_t most, const std::string& what) {
    if (count <= most) return;
    throw InputError(file, "", "more than " + std::to_string(most) + " " + what,
                     "must be at most " + std::to_string(most));
  };
  check(outline_->links.size(), kMaxLinks, "links");
  check(outline_->joints.size(), kMaxLinks, "joints");
  check(num_shapes_, kMaxShapes, "shapes");
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
  Outliner outliner(&outline);
  for (const Element* e = robot->FirstChildElement(); e && !outliner.full();
       e = e->NextSiblingElement()) {
    if (std::strcmp(e->Name(), "link") == 0) outliner.readLink(*e);
    if (std::strcmp(e->Name(), "joint") == 0) outliner.readJoint(*e);
    if (std::strncmp(e->Name(), "xacro:", 6) == 0) {
      outline.problems.push_back({whereIs(*e), "", "is a macro; expand the file with xacro first"});
    }
  }
  outliner.checkCounts(file);
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  outline.xml = printer.CStr();
  return outline;
}

}  // namespace palpate::instrument
