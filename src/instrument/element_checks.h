// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tinyxml2.h>

#include <string>
#include <vector>

#include "palpate/base/error.h"

namespace palpate::instrument {

/// "joint yaw/limit (line 12)", with " attribute" before the line if given.
std::string whereIs(const tinyxml2::XMLElement& element, const char* attribute = nullptr);

/// Text of the attribute, or "" if absent.
std::string text(const tinyxml2::XMLElement& element, const char* attribute);

enum class Need { kOptional, kRequired };
/// Limits: finite; positions within 100 m of the frame; angles and directions up to 1e6; lengths in
/// (0, 100 m]; scales nonzero, up to 1e6. These keep all products finite.
enum class Range { kFinite, kPosition, kDirection, kLength, kScale };

/// Checks that `attribute` of `element` has `count` blank-separated numbers in `range`; else adds a
/// problem. Returns the numbers; empty if absent or wrong.
std::vector<double> checkNumbers(const tinyxml2::XMLElement& element, const char* attribute,
                                 std::size_t count, Range range, Need need,
                                 std::vector<Problem>* problems);

/// Checks <origin>, <geometry> and its shape of a <visual> or <collision>.
void checkShape(const tinyxml2::XMLElement& visual_or_collision, std::vector<Problem>* problems);

/// Checks the numbers of a joint of a supported type: origin, axis, limit, mimic.
void checkJointNumbers(const tinyxml2::XMLElement& joint, std::vector<Problem>* problems);

}  // namespace palpate::instrument
