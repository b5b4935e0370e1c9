// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/instrument/description.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "palpate/base/error.h"
#include "palpate/base/resource.h"
#include "palpate/base/text_file.h"
#include "urdf_outline.h"

namespace palpate::instrument {
namespace {

using Element = tinyxml2::XMLElement;

UrdfOutline readUsable(const std::string& urdf_file) {
  UrdfOutline outline = readOutline(urdf_file, readTextFile(urdf_file, kMaxUrdfBytes));
  checkTopology(&outline);
  if (!outline.problems.empty()) throw InputError(urdf_file, outline.problems);
  return outline;
}

bool isNamed(const Element& element, const char* name) {
  return std::strcmp(element.Name(), name) == 0;
}

/// Value of an attribute, or "".
std::string valueOf(const Element& element, const char* attribute) {
  const char* value = element.Attribute(attribute);
  return value ? value : "";
}

void addPrefix(const std::string& prefix, const char* attribute, Element* element) {
  if (element) element->SetAttribute(attribute, (prefix + valueOf(*element, attribute)).c_str());
}

/// Makes a path absolute for other programs, except package:// paths, which rviz resolves.
void makeAbsolute(const std::string& folder, Element* mesh) {
  const std::string name = valueOf(*mesh, "filename");
  if (name.rfind("package://", 0) == 0) return;
  const std::filesystem::path path = std::filesystem::absolute(resolveResource(name, folder));
  mesh->SetAttribute("filename", ("file://" + path.lexically_normal().string()).c_str());
}

void makeMeshesAbsolute(const std::string& folder, Element* link) {
  for (Element* shape = link->FirstChildElement(); shape; shape = shape->NextSiblingElement()) {
    Element* geometry = shape->FirstChildElement("geometry");
    Element* mesh = geometry ? geometry->FirstChildElement("mesh") : nullptr;
    if (mesh) makeAbsolute(folder, mesh);
  }
}

/// Keeps these links only, each but the first by a floating joint below the first.
void keepLinks(const std::vector<std::string>& links, Element* robot) {
  for (Element* e = robot->FirstChildElement(); e;) {
    Element* const next = e->NextSiblingElement();
    const bool kept = std::find(links.begin(), links.end(), valueOf(*e, "name")) != links.end();
    if (isNamed(*e, "joint") || (isNamed(*e, "link") && !kept)) robot->DeleteChild(e);
    e = next;
  }
  for (std::size_t i = 1; i < links.size(); ++i) {
    Element* joint = robot->InsertNewChildElement("joint");
    joint->SetAttribute("name", ("to " + links[i]).c_str());
    joint->SetAttribute("type", "floating");
    joint->InsertNewChildElement("parent")->SetAttribute("link", links.front().c_str());
    joint->InsertNewChildElement("child")->SetAttribute("link", links[i].c_str());
  }
}

}  // namespace

std::vector<std::string> readLinkNames(const std::string& urdf_file) {
  return readUsable(urdf_file).links;
}

std::string describeUrdf(const std::string& urdf_file, const DescriptionSettings& settings) {
  const UrdfOutline outline = readUsable(urdf_file);
  tinyxml2::XMLDocument document;
  document.Parse(outline.xml.c_str());
  Element* robot = document.RootElement();
  if (!settings.links.empty()) keepLinks(settings.links, robot);
  const std::string folder = std::filesystem::path(urdf_file).parent_path().string();
  for (Element* e = robot->FirstChildElement(); e; e = e->NextSiblingElement()) {
    if (isNamed(*e, "link")) {
      addPrefix(settings.link_prefix, "name", e);
      try {
        makeMeshesAbsolute(folder, e);
      } catch (const std::invalid_argument& error) {
        throw InputError(urdf_file, "link " + valueOf(*e, "name"), "", error.what());
      }
    }
    if (isNamed(*e, "joint")) {
      addPrefix(settings.link_prefix, "link", e->FirstChildElement("parent"));
      addPrefix(settings.link_prefix, "link", e->FirstChildElement("child"));
    }
  }
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

}  // namespace palpate::instrument
