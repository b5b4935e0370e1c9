// SPDX-License-Identifier: GPL-3.0-or-later
#include "element_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include "palpate/base/number.h"

namespace palpate::instrument {
namespace {

using Element = tinyxml2::XMLElement;

constexpr std::size_t kMostNumbers = 3;   // per attribute
constexpr std::size_t kLongestName = 60;  // shown in a report

void checkOrigin(const Element& parent, std::vector<Problem>* problems) {
  const Element* origin = parent.FirstChildElement("origin");
  if (origin == nullptr) return;
  checkNumbers(*origin, "xyz", 3, Range::kPosition, Need::kOptional, problems);
  checkNumbers(*origin, "rpy", 3, Range::kDirection, Need::kOptional, problems);
}

/// Bounds of a Range, and their text.
struct Bounds {
  double most;
  bool positive, not_zero;
  const char* words;
};

Bounds boundsOf(Range range) {
  switch (range) {
    case Range::kPosition:
      return {100.0, false, false, " in [-100, 100]"};
    case Range::kDirection:
      return {1e6, false, false, " in [-1e6, 1e6]"};
    case Range::kLength:
      return {100.0, true, false, " > 0, at most 100"};
    case Range::kScale:
      return {1e6, false, true, " in [-1e6, 1e6], none of them 0"};
    case Range::kFinite:
      break;
  }
  return {std::numeric_limits<double>::max(), false, false, ""};
}

bool inRange(double number, Range range) {
  const Bounds bounds = boundsOf(range);
  return std::abs(number) <= bounds.most && !(bounds.positive && !(number > 0.0)) &&
         !(bounds.not_zero && number == 0.0);
}

std::string describe(std::size_t count, Range range) {
  std::string wish = "must be ";
  wish += count == 1 ? "one finite number" : std::to_string(count) + " finite numbers";
  return wish + boundsOf(range).words;
}

/// All numbers of `text`; empty if there is anything else.
std::vector<double> parseNumbers(const std::string& text) {
  std::istringstream in(text);
  std::vector<double> numbers;
  for (std::string word; in >> word;) {
    if (numbers.size() == kMostNumbers) return {};
    const std::optional<double> number = parseNumber(word);
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

}  // namespace

std::string whereIs(const Element& element, const char* attribute) {
  std::string path;
  for (const tinyxml2::XMLNode* node = &element; node != nullptr; node = node->Parent()) {
    const Element* e = node->ToElement();
    if (e == nullptr || (e->Parent() == e->GetDocument() && e != &element)) break;
    const std::string name = text(*e, "name").substr(0, kLongestName);
    path = std::string(e->Name()).substr(0, kLongestName) + (name.empty() ? "" : " " + name) +
           (path.empty() ? "" : "/") + path;
  }
  if (attribute != nullptr) path += std::string(" ") + attribute;
  return path + " (line " + std::to_string(element.GetLineNum()) + ")";
}

std::string text(const Element& element, const char* attribute) {
  const char* value = element.Attribute(attribute);
  return value == nullptr ? "" : value;
}

std::vector<double> checkNumbers(const Element& element, const char* attribute, std::size_t count,
                                 Range range, Need need, std::vector<Problem>* problems) {
  if (element.Attribute(attribute) == nullptr) {
    if (need == Need::kRequired) {
      problems->push_back(
          {whereIs(element, attribute), "", "is missing; it " + describe(count, range)});
    }
    return {};
  }
  const std::string value = text(element, attribute);
  const std::vector<double> numbers = parseNumbers(value);
  if (numbers.size() == count && std::all_of(numbers.begin(), numbers.end(), [&](double number) {
        return inRange(number, range);
      })) {
    return numbers;
  }
  problems->push_back({whereIs(element, attribute), "'" + value.substr(0, kLongestName) + "'",
                       describe(count, range)});
  return {};
}

void checkShape(const Element& visual_or_collision, std::vector<Problem>* problems) {
  checkOrigin(visual_or_collision, problems);
  const Element* geometry = visual_or_collision.FirstChildElement("geometry");
  const Element* shape = geometry == nullptr ? nullptr : geometry->FirstChildElement();
  if (shape == nullptr) {
    problems->push_back({whereIs(visual_or_collision), "",
                         "needs <geometry> with a sphere, cylinder, box or mesh in it"});
    return;
  }
  const std::string kind = shape->Name();
  if (kind == "sphere") {
    checkNumbers(*shape, "radius", 1, Range::kLength, Need::kRequired, problems);
  } else if (kind == "cylinder") {
    checkNumbers(*shape, "radius", 1, Range::kLength, Need::kRequired, problems);
    checkNumbers(*shape, "length", 1, Range::kLength, Need::kRequired, problems);
  } else if (kind == "box") {
    checkNumbers(*shape, "size", 3, Range::kLength, Need::kRequired, problems);
  } else if (kind == "mesh") {
    if (text(*shape, "filename").empty()) {
      problems->push_back({whereIs(*shape, "filename"), "", "is missing"});
    }
    checkNumbers(*shape, "scale", 3, Range::kScale, Need::kOptional, problems);
  } else {
    problems->push_back({whereIs(*shape), "", "must be a sphere, cylinder, box or mesh"});
  }
}

void checkJointNumbers(const Element& joint, std::vector<Problem>* problems) {
  checkOrigin(joint, problems);
  const std::string type = text(joint, "type");
  if (type == "fixed") return;
  if (const Element* axis = joint.FirstChildElement("axis")) {
    const auto xyz = checkNumbers(*axis, "xyz", 3, Range::kDirection, Need::kRequired, problems);
    if (!xyz.empty() && !(std::hypot(xyz[0], xyz[1], xyz[2]) > 1e-9)) {
      problems->push_back(
          {whereIs(*axis, "xyz"), "'" + text(*axis, "xyz") + "'", "must have a direction"});
    }
  }
  const Element* limit = joint.FirstChildElement("limit");
  if (limit == nullptr && type != "continuous") {
    problems->push_back({whereIs(joint), "", "needs <limit lower= upper= effort= velocity=>"});
  }
  if (limit != nullptr) {
    const auto lower = checkNumbers(*limit, "lower", 1, Range::kFinite, Need::kOptional, problems);
    const auto upper = checkNumbers(*limit, "upper", 1, Range::kFinite, Need::kOptional, problems);
    const double low = lower.empty() ? 0.0 : lower[0], high = upper.empty() ? 0.0 : upper[0];
    if (type != "continuous" && low > high) {
      problems->push_back({whereIs(*limit, "lower"), "'" + text(*limit, "lower") + "'",
                           "must not be above upper = '" + text(*limit, "upper") + "'"});
    }
    checkNumbers(*limit, "effort", 1, Range::kFinite, Need::kRequired, problems);
    checkNumbers(*limit, "velocity", 1, Range::kFinite, Need::kRequired, problems);
  }
  if (const Element* mimic = joint.FirstChildElement("mimic")) {
    checkNumbers(*mimic, "multiplier", 1, Range::kDirection, Need::kOptional, problems);
    checkNumbers(*mimic, "offset", 1, Range::kDirection, Need::kOptional, problems);
  }
}

}  // namespace palpate::instrument
