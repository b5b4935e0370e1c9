// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace palpate::instrument {

/// Names of the links of a URDF file, in the file's order.
/// @throws InputError as readInstrument(), but for collision meshes, which are not read.
std::vector<std::string> readLinkNames(const std::string& urdf_file);

struct DescriptionSettings {
  std::string link_prefix;  ///< Put before the name of each link.
  /// If not empty: the only links that stay, the others and all joints go. Floating joints join the
  /// links to the first of them, since a description is a tree.
  std::vector<std::string> links;
};

/// The text of a URDF for programs in other folders, such as rviz: paths of meshes are absolute.
/// @throws InputError as readLinkNames().
std::string describeUrdf(const std::string& urdf_file, const DescriptionSettings& settings);

}  // namespace palpate::instrument
