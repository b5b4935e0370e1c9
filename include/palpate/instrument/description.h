// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace palpate::instrument {

/// Names of the links of a URDF file, in the file's order.
/// @throws InputError as readInstrument(), but collision meshes are not read.
std::vector<std::string> readLinkNames(const std::string& urdf_file);

struct DescriptionSettings {
  std::string link_prefix;  ///< Prefix of each link name.
  /// If not empty: the only links to keep, without joints. Floating joints attach them to the first
  /// link, since a description must be a tree.
  std::vector<std::string> links;
};

/// Text of a URDF for other programs, for example rviz, with absolute mesh paths.
/// @throws InputError as readLinkNames().
std::string describeUrdf(const std::string& urdf_file, const DescriptionSettings& settings);

}  // namespace palpate::instrument
