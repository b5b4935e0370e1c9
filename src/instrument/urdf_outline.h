// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "palpate/base/error.h"

namespace palpate::instrument {

/// A <joint> of the file.
struct JointOutline {
  std::string where;  ///< "joint NAME (line N)", for reports.
  std::string name, type, parent, child;
  std::string mimic;  ///< Followed joint, or "".
  bool mimics = false;
};

/// Uninterpreted content of a URDF: names in the file's order, and all problems of single elements.
/// The parser urdfdom stops at the first error and logs it; this check reports all by name.
struct UrdfOutline {
  /// The text as rewritten by its parser, without anything that urdfdom would read differently or
  /// endlessly.
  std::string xml;
  std::string robot;
  std::vector<std::string> links;
  std::vector<std::size_t> shapes;  ///< Number of visuals and collisions of each link.
  std::vector<JointOutline> joints;
  std::vector<Problem> problems;
};

/// Largest file [bytes].
constexpr std::size_t kMaxUrdfBytes = 4u << 20;

/// Limit of reported problems.
constexpr std::size_t kMaxProblems = 50;

/// @throws InputError for invalid XML, another root than <robot>, or counts of links, joints or
/// shapes beyond the limits.
UrdfOutline readOutline(const std::string& file, const std::string& text);

/// Adds problems between elements: unknown names, two parents, loops, not exactly one root, mimics
/// of unknown joints or of each other.
void checkTopology(UrdfOutline* outline);

}  // namespace palpate::instrument
