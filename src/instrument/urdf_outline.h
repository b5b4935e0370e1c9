// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "palpate/base/error.h"

namespace palpate::instrument {

/// One <joint> as it stands in the file.
struct JointOutline {
  std::string where;  ///< "joint NAME (line N)", for reports.
  std::string name, type, parent, child;
  std::string mimic;  ///< Joint that it follows, or "".
  bool mimics = false;
};

/// What a URDF says before anybody interprets it: names in the file's order, and all that is wrong
/// in single elements. The parser behind it (urdfdom) stops at the first error and logs it; this
/// look finds them all and names them.
struct UrdfOutline {
  /// The same text, written anew by the parser that has read it: what urdfdom's parser has no end
  /// with, or reads otherwise, is not in it.
  std::string xml;
  std::string robot;
  std::vector<std::string> links;
  std::vector<std::size_t> shapes;  ///< Visuals and collisions, one number a link.
  std::vector<JointOutline> joints;
  std::vector<Problem> problems;
};

/// Of a file.
constexpr std::size_t kMaxUrdfBytes = 4u << 20;

/// More problems than anybody reads; others are not looked for.
constexpr std::size_t kMaxProblems = 50;

/// @throws InputError if `text` is not XML, its root is not <robot>, or there are more links,
/// joints or shapes than any instrument has.
UrdfOutline readOutline(const std::string& file, const std::string& text);

/// Adds what is wrong between elements: names that do not exist, two parents, loops, not exactly
/// one root, mimics that follow nothing or each other.
void checkTopology(UrdfOutline* outline);

}  // namespace palpate::instrument
