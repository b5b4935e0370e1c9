// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tinyxml2.h>

#include <string>
#include <vector>

#include "palpate/base/error.h"

namespace palpate::instrument {

/// "joint yaw/limit (line 12)", with " attribute" put before the line if given.
std::string whereIs(const tinyxml2::XMLElement& element, const char* attribute = nullptr);

/// The attribute's text, or "" if it is not there.
std::string text(const tinyxml2::XMLElement& element, const char* attribute);

enum class Need { kOptional, kRequired };
/// Finite; a place, at most 100 m from its frame; an angle or a direction, at most 1e6; a length,
/// above 0 and at most 100 m; a scale, not 0 and at most 1e6. An instrument is no town, and what is
/// finite must be so in all products too.
enum class Range { kFinite, kPosition, kDirection, kLength, kScale };

/// Checks that `attribute` of `element` is `count` numbers in `range` separated by blanks; adds a
/// problem otherwise. Returns the numbers, or nothing if they are absent or wrong.
std::vector<double> checkNumbers(const tinyxml2::XMLElement& element, const char* attribute,
                                 std::size_t count, Range range, Need need,
                                 std::vector<Problem>* problems);

/// Checks <origin>, <geometry> and the shape in it of a <visual> or <collision>.
void checkShape(const tinyxml2::XMLElement& visual_or_collision, std::vector<Problem>* problems);

/// Checks the numbers of a joint of a supported type: origin, axis, limit, mimic.
void checkJointNumbers(const tinyxml2::XMLElement& joint, std::vector<Problem>* problems);

}  // namespace palpate::instrument
