// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace palpate {

/// The path that a resource name in a file stands for. Whether a file is there is not looked at.
///
///     /abs/file              as it is
///     file:///abs/file       /abs/file
///     rel/file, file://rel   relative to `relative_to_folder`
///     package://NAME/rest    rest in the folder of the ROS package NAME
///
/// A package is looked for, in this order: upwards from `relative_to_folder` (a folder whose
/// package.xml has that name), in the entries of ROS_PACKAGE_PATH (the entry itself and folders up
/// to three below), in share/NAME of the entries of CMAKE_PREFIX_PATH, in /usr/share/NAME.
/// A path, absolute or not, may lead anywhere that the user may read: a file names files of the
/// same user. What is asked of a package stays within it; links in its folder are the package's
/// own.
/// @throws std::invalid_argument if the package is not found (saying where it was looked for), the
/// rest leads out of it, the name is empty or has a zero byte, or it begins with another scheme.
std::string resolveResource(const std::string& uri, const std::string& relative_to_folder);

}  // namespace palpate
